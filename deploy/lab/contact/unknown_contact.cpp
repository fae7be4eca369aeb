// Is the displayed contact correct if the material is unknown to the slave? The simulated operator touches,
// presses and probes random materials with the default settings over every link.
//
// Evaluated over the last two cycles of the probing: the slope of the contact force at the hand over the
// position of the handle, and the mean force, are compared with those of the material at the depth of the
// handle. The uncertainty of the reported stiffness, at the position for which it was reported, is compared
// with the Cramér-Rao bound of all samples behind the surface with unknown k, λ, n and surface. For materials
// outside the Hunt-Crossley family only the tangent is compared.

#include "deploy/lab/contact/unknown_contact.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"
#include "common/core/regression.hpp"
#include "deploy/lab/laboratory.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {
namespace {

constexpr double kWall_m = 0.105;  // distance from the start of the tool, along x
constexpr double kCycles = 4.0;
constexpr double kEngagesAnew_s = 30.0;
constexpr double kLeft_m = 5e-4;  // distance in front of the surface at which the press is over
constexpr double kStillWatched_s = 1.0, kStillTries = 5.0;

/// Minimum variance of a tangent stiffness from all samples of a touch so far.
class Bound {
 public:
  explicit Bound(const UnknownCell& cell) : cell_(cell) {}

  void begin() { information_.setZero(); }
  void add(double depth_m, double speed) {
    if (depth_m <= 0.0) return;
    const double reference = cell_.depth_m(), log_depth = std::log(depth_m / reference);
    const double elastic = cell_.elastic_n(depth_m), force = cell_.force_n(depth_m, speed);
    const Eigen::Vector4d h(force, force * log_depth, elastic * speed / reference,
                            -cell_.n * force / depth_m * reference);
    information_ += h * h.transpose() / (cell_.noise_n * cell_.noise_n);
  }
  /// Relative standard deviation at this depth; infinite if nothing is known.
  [[nodiscard]] double sd(double depth_m) const {
    if (depth_m <= 0.0) return INFINITY;
    const double reference = cell_.depth_m();
    const Eigen::Vector4d h(1.0, std::log(depth_m / reference) + 1.0 / cell_.n, 0.0,
                            -(cell_.n - 1.0) * reference / depth_m);
    const Eigen::FullPivLU<Eigen::Matrix4d> lu(information_);
    const double variance = lu.isInvertible() ? h.dot(lu.solve(h)) : INFINITY;
    return variance > 0.0 ? std::sqrt(variance) : INFINITY;
  }

 private:
  const UnknownCell& cell_;
  Eigen::Matrix4d information_ = Eigen::Matrix4d::Zero();
};

ExperimentRun configured(const ExperimentRun& run, const UnknownCell& cell, const CellSettings& settings) {
  ExperimentRun there;
  there.config = run.config;
  there.seed = run.seed;
  proto::MasterConfig& master = *there.config.mutable_master();
  proto::SlaveConfig& slave = *there.config.mutable_slave();
  const proto::LinkProfile link = load_link_profile(find_deploy_folder(), cell.link);
  take_profile(*master.mutable_link(), link);
  take_profile(*slave.mutable_link(), link);
  master.mutable_hand()->set_grip(cell.grip == Grip::kFirm ? proto::Hand::FIRM : proto::Hand::LIGHT);
  master.mutable_mapping()->set_scale(cell.scale);
  there.config.set_duration_s(120.0 + 30.0 * (link.up().delay_s() + link.down().delay_s()));
  const double hand_n = cell.tool_n / cell.scale;
  master.mutable_operator_()->set_press_n(hand_n);
  master.mutable_operator_()->set_probe_n(cell.probe_share * hand_n);
  // Until the effect of the probing has returned, twice.
  const double rtt_s =
      link.up().delay_s() + link.up().step_delay_s() + link.down().delay_s() + link.down().step_delay_s();
  const double cycles = kCycles + std::ceil(2.0 * rtt_s * master.operator_().probe_hz());
  master.mutable_operator_()->set_probe_cycles(static_cast<std::uint32_t>(cycles));
  slave.mutable_sensing()->set_force_noise_n(cell.noise_n);
  if (settings.assumed_exponent > 0.0) {
    slave.mutable_estimator()->set_kind(proto::Estimator::FIXED_EXPONENT);
    slave.mutable_estimator()->set_exponent(settings.assumed_exponent);
  }
  if (settings.never_follows) slave.mutable_estimator()->set_depth_memory_s(60.0);
  // The force of the material is added to the reports of the sensor, so that any law can be simulated.
  if (slave.robot().mjcf().empty())
    slave.mutable_scene()->mutable_surface(0)->mutable_plane()->set_point_m(0, 10.0);
  return there;
}

class Press {
 public:
  /// `noise_unreported` is the actual noise of the sensor relative to the configured noise.
  Press(const ExperimentRun& run, const UnknownCell& cell, double noise_unreported)
      : cell_(cell),
        more_noise_n_(std::sqrt(std::max(noise_unreported * noise_unreported - 1.0, 0.0)) * cell.noise_n),
        random_(Random(run.seed).child("untold noise")),
        master_(to_struct(run.config.master())),
        lab_(master_, to_struct(run.config.slave()), run.seed),
        bound_(cell),
        end_s_(run.config.duration_s()) {
    wall_m_ = lab_.arm().start_pose().p.x() + kWall_m;
    lab_.set_fault_hooks(pushes_);
  }

  UnknownResult go() {
    const double cycles_s = 2.0 / master_.operator_.probe_hz;
    const double probing_s = master_.operator_.probe_cycles / master_.operator_.probe_hz;
    double entered_s = -1.0;
    for (std::int64_t i = 0; lab_.now_s() < end_s_ && lab_.script().cycles() == 0; ++i) {
      // The person engages again after a stop.
      if (lab_.now_s() > kEngagesAnew_s && lab_.master().state != SafetyState::kEngaged && i % 1000 == 0)
        lab_.requests().engage = true;
      lab_.step();
      watch();
      const bool probing = lab_.script().phase() == ScriptPhase::kProbe;
      if (!probing) entered_s = -1.0;
      if (probing && entered_s < 0.0) {
        entered_s = lab_.now_s();
        felt_ = true_ = LineFit();
        felt_n_ = true_n_ = 0.0;
      }
      if (probing && lab_.now_s() - entered_s > probing_s - cycles_s) feel();
      if (probing) judge_estimate();
    }
    result_.rtt_s = lab_.link().rtt_s.value_or(0.0);
    result_.probed = lab_.script().cycles() > 0 && felt_.count() > 0;
    if (!result_.probed) return result_;
    result_.slope_error = felt_.slope() / true_.slope() - 1.0;
    result_.force_error = felt_n_ / true_n_ - 1.0;
    hold_still();
    return result_;
  }
  /// Runs only until the first value.
  double first_s() {
    while (lab_.now_s() < end_s_ && result_.first_s < 0.0) {
      lab_.step();
      watch();
    }
    return result_.first_s;
  }

 private:
  [[nodiscard]] double depth(const Vector3& p_WE) const { return p_WE.x() - wall_m_; }

  void push(RobotState& robot) {
    const double depth_m = depth(lab_.arm().true_pose().p), speed = lab_.arm().true_velocity().x();
    robot.F_F_W.force.x() += more_noise_n_ * random_.normal() - cell_.force_n(depth_m, speed);
    if (!behind_ && depth_m > 0.0) ++result_.presses;
    behind_ = behind_ ? depth_m > -kLeft_m : depth_m > 0.0;
    const SlaveView& s = lab_.slave();
    if (depth_m <= 0.0) bound_.begin();
    if (s.touch != touch_) ++result_.contacts;
    touch_ = s.touch;
    bound_.add(depth_m, speed);
  }

  void watch() {
    const SlaveView& s = lab_.slave();
    result_.returned_j = std::max(result_.returned_j, -lab_.master().port_energy_j);
    const double depth_m = depth(lab_.arm().true_pose().p);
    if (touched_s_ < 0.0 && depth_m > 0.0) touched_s_ = lab_.now_s();
    if (touched_s_ < 0.0) return;
    const double since_s = lab_.now_s() - touched_s_;
    if (result_.first_s < 0.0 && s.reported_stiffness_n_per_m > 0.0) result_.first_s = since_s;
    if (result_.bound_first_s < 0.0 && bound_.sd(depth_m) < 0.03) result_.bound_first_s = since_s;
  }

  /// Evaluation at the handle.
  void feel() {
    const MasterView& m = lab_.master();
    if (m.state != SafetyState::kEngaged) return;
    const double depth_m = depth(lab_.slave().X_WE_anchor.p + m.goal_m), x_m = m.p_MH.x();
    const double true_n = cell_.elastic_n(depth_m) / m.scale, felt_n = m.spring_force_n.norm();
    felt_.add(x_m, felt_n);
    true_.add(x_m, true_n);
    felt_n_ += felt_n;
    true_n_ += true_n;
  }

  void judge_estimate() {
    const SlaveView& s = lab_.slave();
    if (!s.in_contact || !s.estimate.valid || s.reported_stiffness_n_per_m <= 0.0) return;
    const double reported_m = depth(s.reported_at_m);
    const double there = cell_.tangent_n_per_m(reported_m);
    result_.reported_sd = s.estimate.stiffness_sd_n_per_m / s.reported_stiffness_n_per_m;
    result_.power_law = s.estimate.n_verdict != Verdict::kNoPowerLaw;
    result_.reported_error = there > 0.0 ? s.reported_stiffness_n_per_m / there - 1.0 : 1.0;
    const double here = cell_.tangent_n_per_m(depth(lab_.arm().true_pose().p));
    result_.estimate_error = here > 0.0 ? s.estimate.stiffness_n_per_m / here - 1.0 : 1.0;
    result_.estimate_sd = s.estimate.stiffness_sd_n_per_m / s.estimate.stiffness_n_per_m;
    result_.bound_sd = bound_.sd(depth(lab_.arm().true_pose().p));
  }

  /// Holds the hand at its present position: a handle that still moves is in a limit cycle. The observation
  /// is repeated if the system holds meanwhile because of a link timeout.
  void hold_still() {
    HandTarget target{.grip = cell_.grip};
    const double stiffness = hand_model(cell_.grip).stiffness_n_per_m;
    target.position_m = lab_.master().p_MH - lab_.master().F_H_M.force / stiffness;
    lab_.drive(target);
    const double settles_s = 3.0 + 2.0 * lab_.link().rtt_s.value_or(0.0);
    const double last_s = lab_.now_s() + kStillTries * settles_s;
    double rest_s = lab_.now_s() + settles_s;
    double low_m = INFINITY, high_m = -INFINITY;
    while (lab_.now_s() < rest_s + kStillWatched_s) {
      lab_.step();
      watch();
      if (lab_.master().state != SafetyState::kEngaged && lab_.now_s() < last_s) {
        rest_s = lab_.now_s() + settles_s;
        low_m = INFINITY, high_m = -INFINITY;
      }
      if (lab_.now_s() < rest_s) continue;
      low_m = std::min(low_m, lab_.master().p_MH.x());
      high_m = std::max(high_m, lab_.master().p_MH.x());
    }
    result_.ripple_m = high_m - low_m;
  }

  const UnknownCell& cell_;
  double more_noise_n_;
  Random random_;
  bool behind_ = false;  // positions of the tool and of the surface
  MasterConfig master_;
  OnRobot pushes_{[this](Time, RobotState& robot) { push(robot); }};
  Laboratory lab_;
  Bound bound_;
  double end_s_, wall_m_ = 0.0, touched_s_ = -1.0;
  std::uint32_t touch_ = 0;
  LineFit felt_, true_;
  double felt_n_ = 0.0, true_n_ = 0.0;
  UnknownResult result_;
};

}  // namespace

UnknownResult run_cell(const ExperimentRun& run, const UnknownCell& cell, const CellSettings& settings) {
  UnknownResult result = Press(configured(run, cell, settings), cell, settings.noise_unreported).go();
  if (settings.fixed_too)
    result.fixed_first_s = Press(configured(run, cell, {.assumed_exponent = cell.n}), cell, 1.0).first_s();
  return result;
}

}  // namespace longreach
