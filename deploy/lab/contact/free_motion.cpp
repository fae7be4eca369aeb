#include "deploy/lab/contact/free_motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"
#include "deploy/lab/laboratory.hpp"
#include "slave/sensing/touch_threshold.hpp"

namespace longreach {
namespace {

constexpr double kBox_m = 0.12;   // half of the edge of the box in which the tool moves
constexpr double kNear_m = 0.05;  // distance from a point at which the tool turns to the next one
constexpr double kFast_m_per_s = 0.25;
constexpr double kFirmHand_n_per_m = 400.0;
constexpr double kRest_s = 1.0;
constexpr double kSteady_s = 1.0;  // duration of the motion at the approach speed before the wall
constexpr double kAtWall_s = 1.0;  // maximum time at the wall; for a slow approach
constexpr double kSlow_s = 120.0;
constexpr double kMost_n = 8.0;   // a contact must be reported before the force reaches this value
constexpr double kBias_n = 10.0;  // maximum offset, including the weight that is not compensated
constexpr double kSlow_m_per_s = 1e-4, kSlow_n_per_m = 200.0;
constexpr double kEarth_m_per_s2 = 9.81;
constexpr double kLever_m = 0.1;  // noise, drift and bias of the moment, relative to those of the force

/// The true properties of the robot and its sensor.
SlaveConfig true_config(const ExperimentRun& run, const FreeMotionCell& cell) {
  proto::SlaveConfig message = run.config.slave();
  take_profile(*message.mutable_link(), load_link_profile(find_deploy_folder(), "lab"));
  SlaveConfig config = to_struct(message);
  for (SurfaceConfig& s : config.scene.surface) s.plane->point_m = {10.0, 0.0, 0.0};
  SensingConfig& sensor = config.sensing;
  sensor.force_noise_n = cell.noise_n;
  sensor.moment_noise_nm = kLever_m * cell.noise_n;
  sensor.force_drift_n = cell.drift_n;
  sensor.moment_drift_nm = kLever_m * cell.drift_n;
  sensor.force_bias_n = cell.bias_n / std::sqrt(3.0);
  sensor.moment_bias_nm = kLever_m * sensor.force_bias_n;
  sensor.tool = {cell.mass_kg, {0.0, 0.0, 0.05}, Vector3::Constant(1e-3 * cell.mass_kg)};
  if (cell.gravity) sensor.gravity_m_per_s2 = {0.0, 0.0, -kEarth_m_per_s2};
  return config;
}

/// The configuration of the slave: default noise and drift, and a wrong mass.
SlaveConfig slave_config(const ExperimentRun& run, const FreeMotionCell& cell) {
  SlaveConfig config = true_config(run, cell);
  const SensingConfig usual = to_struct(run.config.slave()).sensing;
  config.sensing.force_noise_n = usual.force_noise_n;
  config.sensing.moment_noise_nm = usual.moment_noise_nm;
  config.sensing.force_drift_n = usual.force_drift_n;
  config.sensing.moment_drift_nm = usual.moment_drift_nm;
  config.sensing.tool.mass_kg *= 1.0 + cell.mass_error;
  config.sensing.touch_n = cell.touch_n;
  return config;
}

MasterConfig master_config(const ExperimentRun& run) {
  proto::MasterConfig message = run.config.master();
  take_profile(*message.mutable_link(), load_link_profile(find_deploy_folder(), "lab"));
  MasterConfig config = to_struct(message);
  config.safety.engage_at_start = true;
  config.mapping.mode = MotionMode::kRate;
  config.mapping.scale = 1.0;
  config.hand.grip = Grip::kFirm;
  return config;
}

class FreeMotion {
 public:
  FreeMotion(const ExperimentRun& run, const FreeMotionCell& cell)
      : cell_(cell),
        master_(master_config(run)),
        lab_(master_, true_config(run, cell), run.seed),
        random_(Random(run.seed).child("motion")) {
    lab_.configure_slave(slave_config(run, cell));
    lab_.set_fault_hooks(pushes_);
  }

  FreeMotionResult go() {
    const double end_s = lab_.now_s() + 30.0;
    while (lab_.master().state != SafetyState::kEngaged && lab_.now_s() < end_s) tick(Vector3::Zero());
    wander();
    for (double t = 0.0; t < kRest_s; t += lab_.period_s()) tick(Vector3::Zero());
    meet();
    return out_;
  }

 private:
  [[nodiscard]] Vector3 tool_m() const { return lab_.arm().true_pose().p - lab_.arm().start_pose().p; }

  /// Moves from point to point in a box in rate mode.
  void wander() {
    Vector3 to_m = Vector3::Zero();
    const double end_s = lab_.now_s() + cell_.moving_s;
    while (lab_.now_s() < end_s) {
      if ((to_m - tool_m()).norm() < kNear_m)
        for (double& x : to_m) x = random_.uniform(-kBox_m, kBox_m);
      tick(kFast_m_per_s * (to_m - tool_m()).normalized());
    }
  }

  void meet() {
    const Vector3 speed(cell_.speed_m_per_s, 0.0, 0.0);
    for (double t = 0.0; t < kSteady_s; t += lab_.period_s()) tick(speed);
    wall_m_ = tool_m().x();
    out_.touch_n = lab_.slave().sensor_zero.touch_n;
    const double end_s = lab_.now_s() + (cell_.speed_m_per_s > kSlow_m_per_s ? kAtWall_s : kSlow_s);
    double twice_s = 0.0;
    while (lab_.now_s() < end_s && !out_.found && wall_n_ < kMost_n) {
      tick(speed);
      if (twice_s == 0.0 && wall_n_ >= 2.0 * out_.touch_n) twice_s = lab_.now_s();
      if (!lab_.slave().in_contact) continue;
      out_.found = true;
      out_.found_n = wall_n_;
      if (twice_s > 0.0) out_.found_s = lab_.now_s() - twice_s;
    }
  }

  /// `v` is the velocity of the tool that the hand commands.
  void tick(const Vector3& v) {
    const double spring = 1.0 + master_.rendering.rate_stiffness_n_per_m / kFirmHand_n_per_m;
    HandTarget hand;
    hand.grip = Grip::kFirm;
    if (!v.isZero(0.0))
      hand.position_m =
          spring * (master_.mapping.dead_zone_m / v.norm() + 1.0 / master_.mapping.kv_per_s) * v;
    lab_.drive(hand);
    if (wall_m_) wall_n_ = cell_.stiffness_n_per_m * std::max(tool_m().x() - *wall_m_, 0.0);
    lab_.step();
    const Vector3 now_m = tool_m();
    const bool contact = lab_.slave().in_contact;
    if (contact && !contact_ && !wall_m_ && out_.false_contacts++ == 0) out_.false_s = lab_.now_s();
    if (!contact && (now_m - before_m_).norm() > kFreeSpeed_m_per_s * lab_.period_s())
      out_.moved_s += lab_.period_s();
    contact_ = contact;
    before_m_ = now_m;
  }

  FreeMotionCell cell_;
  MasterConfig master_;
  OnRobot pushes_{[this](Time, RobotState& robot) { robot.F_F_W.force.x() -= wall_n_; }};
  Laboratory lab_;
  Random random_;
  FreeMotionResult out_{};
  Vector3 before_m_ = Vector3::Zero();
  std::optional<double> wall_m_{};  // position along x; std::nullopt: no wall yet
  double wall_n_ = 0.0;
  bool contact_ = false;
};

}  // namespace

FreeMotionCell draw_free_motion(Random& random, bool slow) {
  FreeMotionCell cell;
  cell.noise_n = random.log_uniform(0.01, 0.5);
  cell.mass_kg = random.log_uniform(0.5, 5.0);
  cell.mass_error = random.chance(0.5) ? 0.1 : -0.1;
  cell.gravity = random.chance(0.5);
  const double weight_n = cell.gravity ? std::abs(cell.mass_error) * cell.mass_kg * kEarth_m_per_s2 : 0.0;
  cell.bias_n = random.uniform(0.0, kBias_n - weight_n);
  cell.speed_m_per_s = slow ? kSlow_m_per_s : random.log_uniform(0.006, 0.05);
  cell.stiffness_n_per_m = slow ? kSlow_n_per_m : random.log_uniform(200.0, 5000.0);
  return cell;
}

FreeMotionResult run_free_motion(const ExperimentRun& run, const FreeMotionCell& cell) {
  return FreeMotion(run, cell).go();
}

}  // namespace longreach
