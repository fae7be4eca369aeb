#include "deploy/lab/contact/drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"
#include "deploy/lab/laboratory.hpp"
#include "slave/simulation/scene/free_bodies.hpp"

namespace longreach {
namespace {

constexpr double kWay_m = 0.03;   // distance of a drag
constexpr double kPause_s = 1.5;  // pause after each drag, in addition to the round trip
constexpr int kDrags = 4;
constexpr double kLoadToWall_m = 0.03;  // distance from the load, along x
constexpr double kWallDrag_m = 0.05;    // motion of the hand into the wall
constexpr double kHand_n_per_m = 400.0;
constexpr double kRamp_s = 0.15;  // time in which a person's hand accelerates
constexpr double kMoved = 0.5;    // fraction of the distance that the tool must have moved
constexpr double kShare = 0.75;   // maximum inertial force of the load relative to the force guard

std::string number(double value) { return std::to_string(value); }

SlaveConfig slave_config(const ExperimentRun& run, const DragCell& cell) {
  proto::SlaveConfig message = run.config.slave();
  take_profile(*message.mutable_link(), load_link_profile(find_deploy_folder(), cell.link));
  message.mutable_sensing()->set_force_noise_n(cell.noise_n);
  message.mutable_sensing()->set_moment_noise_nm(0.1 * cell.noise_n);
  message.mutable_command()->set_acceleration_max_m_per_s2(cell.acceleration_m_per_s2);
  SlaveConfig config = to_struct(message);
  config.scene.surface.clear();
  config.scene.material = {{"hard", 2e4, 0.001, 1.0, 0.5}};
  config.scene.bodies = bodies_of(cell);
  return config;
}

MasterConfig master_config(const ExperimentRun& run, const DragCell& cell) {
  proto::MasterConfig message = run.config.master();
  take_profile(*message.mutable_link(), load_link_profile(find_deploy_folder(), cell.link));
  MasterConfig config = to_struct(message);
  config.safety.engage_at_start = true;
  config.mapping.mode = cell.mode;
  config.mapping.scale = 1.0;
  config.hand.grip = Grip::kFirm;
  config.rendering.load_factor = 1.0;  // so that the same hand commands the same motion with an empty gripper
  return config;
}

/// A run with one load, or with the same hand and an empty gripper.
class Drag {
 public:
  Drag(const ExperimentRun& run, const DragCell& cell)
      : cell_(cell), master_(master_config(run, cell)), lab_(master_, slave_config(run, cell), run.seed) {}

  /// Runs it and returns the position of the tool along x at the end of each rest, relative to its start.
  DragResult go(std::array<double, kDrags>& rests_m) {
    wait(1.0, true);
    rtt_s_ = lab_.master().rtt_s.value_or(0.0);
    lab_.requests().grip = true;
    wait(rtt_s_ + 0.5, true);
    out_.held = lab_.arm().bodies()->contact().holds;
    began_s_ = lab_.now_s();
    if (cell_.known) {
      for (const double sense : {-1.0, 1.0}) {
        move(sense);
        wait(rtt_s_ + kPause_s, false);
      }
    }
    for (int i = 0; i < (cell_.wall ? 1 : kDrags); ++i) {
      move(i % 2 == 0 ? 1.0 : -1.0);
      wait(rtt_s_ + kPause_s, false);
      rests_m[static_cast<std::size_t>(i)] = tool_m();
      if (i == 0) out_.moved = tool_m() > kMoved * (cell_.wall ? kLoadToWall_m : kWay_m);
    }
    out_.reported_kg = lab_.slave().gripper.load_kg;
    out_.reported_sd_kg = lab_.slave().gripper.load_sd_kg;
    return out_;
  }

 private:
  [[nodiscard]] double tool_m() const { return lab_.arm().true_pose().p.x() - lab_.arm().start_pose().p.x(); }

  void wait(double seconds, bool until_engaged) {
    const double end_s = lab_.now_s() + seconds;
    while (lab_.now_s() < end_s ||
           (until_engaged && lab_.master().state != SafetyState::kEngaged && lab_.now_s() < end_s + 30.0))
      tick();
  }

  /// The hand accelerates, moves at a constant speed, and stops. In rate mode it deflects the handle and
  /// returns to the centre.
  void move(double sense) {
    const double v = cell_.speed_m_per_s, way_m = cell_.wall ? kWallDrag_m : kWay_m;
    const double steady_s = std::max(way_m / v - kRamp_s, 0.0), all_s = steady_s + 2.0 * kRamp_s;
    const double spring = 1.0 + master_.rendering.rate_stiffness_n_per_m / kHand_n_per_m;
    for (double t = 0.0; t < all_s; t += lab_.period_s()) {
      const double share = std::clamp(std::min(t, all_s - t) / kRamp_s, 0.0, 1.0);
      if (cell_.mode == MotionMode::kPosition) {
        hand_m_ += sense * share * v * lab_.period_s();
      } else {
        hand_m_ = sense * share * spring * (master_.mapping.dead_zone_m + v / master_.mapping.kv_per_s);
      }
      tick();
    }
    if (cell_.mode == MotionMode::kRate) hand_m_ = 0.0;
  }

  void tick() {
    HandTarget hand;
    hand.position_m.x() = hand_m_;
    hand.grip = Grip::kFirm;
    lab_.drive(hand);
    lab_.step();
    const SlaveView& slave = lab_.slave();
    const BodiesContact& met = lab_.arm().bodies()->contact();
    if (met.contacts > 0 && met_s_ == 0.0) met_s_ = lab_.now_s();
    if (slave.in_contact && !contact_) {
      if (met_s_ == 0.0) ++out_.phantoms;
      if (met_s_ > 0.0 && out_.found_s == 0.0) out_.found_s = lab_.now_s() - met_s_;
    }
    contact_ = slave.in_contact;
    const bool engaged = slave.state == SafetyState::kEngaged;
    out_.holds += engaged_ && !engaged;
    engaged_ = engaged;
    const double speed = lab_.arm().bodies()->state(0).v_m_per_s.norm();
    if (out_.held) {
      slow_ += 0.1 * (speed - slow_);
      out_.push_n = std::max(out_.push_n, cell_.mass_kg * std::abs(slow_ - before_) / lab_.period_s());
      before_ = slow_;
    }
    if (out_.reported_s == 0.0 && slave.gripper.load_sd_kg > 0.0 && began_s_ > 0.0)
      out_.reported_s = lab_.now_s() - began_s_;
  }

  DragCell cell_;
  MasterConfig master_;
  Laboratory lab_;
  DragResult out_{};
  double rtt_s_ = 0.0, began_s_ = 0.0, hand_m_ = 0.0, met_s_ = 0.0;
  double slow_ = 0.0, before_ = 0.0;  // speed of the load, smoothed over 10 ms
  bool contact_ = false, engaged_ = false;
};

}  // namespace

/// A cube, which the tool grasps at the centre of its near side, and a wall behind it.
BodiesConfig bodies_of(const DragCell& cell) {
  const double half_m = 0.05, far_m = 2.0 * half_m + (cell.wall ? kLoadToWall_m : 10.0);
  BodiesConfig all;
  all.mjcf_file = "drag.xml";
  all.file = {{all.mjcf_file,
               "<mujoco><option gravity='0 0 0'/><asset><material name='hard'/></asset><worldbody>"
               "<body name='tool'><freejoint/><geom type='sphere' size='0.02' mass='1' pos='-0.1 0 0' "
               "material='hard'/></body>"
               "<body name='load' pos='0.06 0 0'><freejoint/><geom type='box' size='0.05 0.05 0.05' mass='" +
                   number(cell.mass_kg > 0.0 ? cell.mass_kg : 1.0) +
                   "' material='hard'/><site name='fixture' pos='" + (cell.mass_kg > 0.0 ? "-0.06" : "0.5") +
                   " 0 0'/></body>"
                   "<body name='wall' pos='" +
                   number(0.01 + far_m + 0.05) +
                   " 0 0'><geom type='box' size='0.05 0.5 0.5' material='hard'/></body>"
                   "</worldbody></mujoco>"}};
  all.gripper.emplace();
  return all;
}

DragCell draw_drag(Random& random) {
  static constexpr const char* kLinks[] = {"lab", "kontur", "moon"};
  const double guard_n = CommandConfig{}.force_guard_n;
  DragCell cell;
  cell.link = kLinks[static_cast<std::size_t>(random.uniform(0.0, 3.0))];
  cell.mass_kg = random.log_uniform(0.5, 30.0);
  cell.speed_m_per_s = random.log_uniform(0.005, 0.05);
  cell.acceleration_m_per_s2 =
      std::min(CommandConfig{}.acceleration_max_m_per_s2, kShare * guard_n / cell.mass_kg);
  cell.noise_n = random.log_uniform(0.01, 0.1);
  cell.mode = random.chance(0.5) ? MotionMode::kRate : MotionMode::kPosition;
  return cell;
}

DragResult run_drag(const ExperimentRun& run, const DragCell& cell) {
  std::array<double, kDrags> with{}, without{};
  DragResult out = Drag(run, cell).go(with);
  if (cell.wall || !(cell.mass_kg > 0.0)) return out;
  DragCell empty = cell;
  empty.mass_kg = 0.0;
  // An outage of the link interrupts both.
  out.holds = std::max(0, out.holds - Drag(run, empty).go(without).holds);
  for (std::size_t i = 0; i < kDrags; ++i)
    out.overrun_m = std::max(out.overrun_m, std::abs(with[i] - without[i]));
  return out;
}

}  // namespace longreach
