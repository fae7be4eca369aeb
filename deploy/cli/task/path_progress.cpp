#include "deploy/cli/task/path_progress.hpp"

#include <algorithm>

#include "common/config/config.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {
namespace {

constexpr double kNear_m = 0.01;  // to a ball, if the path turns at a point

Vector3 in_world(const PathConfig& config, const WaypointConfig& waypoint, const Vector3& p_WE_start) {
  return config.from_tool_start ? Vector3(p_WE_start + waypoint.point_m) : waypoint.point_m;
}

}  // namespace

PathProgress::PathProgress(const PathConfig& config, const Vector3& p_WE_start)
    : path_(config, p_WE_start),
      start_m_(in_world(config, config.waypoint.front(), p_WE_start)),
      target_m_(in_world(config, config.waypoint.back(), p_WE_start)) {
  for (std::size_t i = 1; i + 1 < config.waypoint.size(); ++i)
    balls_.push_back({path_.place(in_world(config, config.waypoint[i], p_WE_start)).along_m,
                      std::max(config.turn_radius_m, kNear_m)});
}

void PathProgress::step(double t_s, const Vector3& tool_m) {
  const Path::Place place = path_.place(tool_m);
  error_m_ = place.distance_m;
  const double dt_s = before_s_ ? std::max(t_s - *before_s_, 0.0) : 0.0;
  before_s_ = t_s;
  const bool at_start = (tool_m - start_m_).norm() <= kAtStart_m;
  const bool begun = phase_ == PathPhase::kUnderway && figures_.passed > 0;
  if (at_start && !begun) {
    phase_ = PathPhase::kReady;
    return;
  }
  if (phase_ == PathPhase::kReady) {
    phase_ = PathPhase::kUnderway;
    figures_ = {};
    error_sum_ms_ = 0.0;
  }
  if (phase_ != PathPhase::kUnderway) return;
  figures_.time_s += dt_s;
  error_sum_ms_ += dt_s * error_m_;
  figures_.max_error_m = std::max(figures_.max_error_m, error_m_);
  const auto next = static_cast<std::size_t>(figures_.passed);
  if (next < balls_.size()) {
    const double behind_m = place.along_m - balls_[next].along_m;
    if (behind_m >= 0.0 && std::max(behind_m, error_m_) <= balls_[next].near_m) ++figures_.passed;
  } else if ((tool_m - target_m_).norm() <= kAtTarget_m) {
    phase_ = PathPhase::kDone;
  }
}

PathFigures PathProgress::figures() const {
  PathFigures figures = figures_;
  figures.mean_error_m = figures.time_s > 0.0 ? error_sum_ms_ / figures.time_s : 0.0;
  return figures;
}

std::optional<PathProgress> path_of(const proto::Robot& robot, const proto::Scene& scene) {
  proto::SlaveConfig message;
  *message.mutable_robot() = robot;
  *message.mutable_scene() = scene;
  const SlaveConfig slave = to_struct(message);
  if (!slave.scene.path) return std::nullopt;
  return PathProgress(*slave.scene.path, Kinematics(slave.robot).forward(start_joints(slave.robot)).p);
}

}  // namespace longreach
