#include "deploy/cli/task/dock_progress.hpp"

#include <algorithm>

#include "common/config/config.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {

DockProgress::DockProgress(const BodyGoalConfig& goal, const Vector3& p_WE_start)
    : goal_(goal), X_WG_{p_WE_start + goal.position_m, exp_rotation(goal.rotation_rad)} {}

void DockProgress::step(const DockSample& sample) {
  if (!from_m_) from_m_ = sample.tool_m;
  const double dt_s = before_s_ ? std::max(sample.t_s - *before_s_, 0.0) : 0.0;
  before_s_ = sample.t_s;
  if (phase_ == DockPhase::kDone) return;
  if (phase_ == DockPhase::kWaiting && (sample.tool_m - *from_m_).norm() > kMoved_m)
    phase_ = DockPhase::kBegun;
  else if (phase_ != DockPhase::kWaiting)
    figures_.time_s += dt_s;
  if (!sample.X_WB) return;
  known_ = true;
  figures_.position_error_m = (sample.X_WB->p - X_WG_.p).norm();
  figures_.angle_error_rad = sample.X_WB->q.angularDistance(X_WG_.q);
  if (phase_ != DockPhase::kWaiting) judge(sample, *sample.X_WB);
}

void DockProgress::judge(const DockSample& sample, const Pose& X_WB) {
  const bool within =
      figures_.position_error_m <= goal_.within_m && figures_.angle_error_rad <= goal_.within_rad;
  const double distance_m = (sample.tool_m - X_WB.p).norm();
  if (!within) {
    peak_n_ = 0.0;
    phase_ = sample.holds ? DockPhase::kHeld : DockPhase::kBegun;
  } else if (phase_ == DockPhase::kSeated && !sample.holds) {
    phase_ = DockPhase::kReleased;
    released_at_m_ = distance_m;
  } else if (phase_ == DockPhase::kReleased) {
    if (sample.holds) phase_ = DockPhase::kSeated;
    if (distance_m - released_at_m_ > kRetreat_m) phase_ = DockPhase::kDone;
  } else if (phase_ != DockPhase::kSeated) {
    phase_ = sample.holds ? DockPhase::kHeld : DockPhase::kBegun;
    peak_n_ = sample.holds ? std::max(peak_n_, sample.force_n) : 0.0;
    const bool vanished = goal_.force_n == 0.0 || sample.force_n <= kVanished * goal_.force_n;
    if (sample.holds && peak_n_ >= goal_.force_n && vanished) {
      phase_ = DockPhase::kSeated;
      figures_.seat_force_n = peak_n_;
      if (figures_.seat_s == 0.0) figures_.seat_s = figures_.time_s;
    }
  }
  if (sample.holds && figures_.grasp_s == 0.0) figures_.grasp_s = figures_.time_s;
}

std::optional<DockProgress> dock_of(const proto::Robot& robot, const proto::Scene& scene) {
  proto::SlaveConfig message;
  *message.mutable_robot() = robot;
  *message.mutable_scene() = scene;
  const SlaveConfig slave = to_struct(message);
  if (!slave.scene.bodies || !slave.scene.bodies->goal) return std::nullopt;
  return DockProgress(*slave.scene.bodies->goal,
                      Kinematics(slave.robot).forward(start_joints(slave.robot)).p);
}

}  // namespace longreach
