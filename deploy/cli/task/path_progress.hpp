#pragma once
// One attempt after the other at the path of a scene, judged by the poses of the tool that arrive over the link. An attempt
// begins when the tool leaves the start of the path. There is a ball at each turning point; it is passed when the tool is at
// most the turn radius beside the path, and the same length behind the middle of the turn. When all balls are passed in their order, the attempt ends
// where the tool reaches the target, the end of the path (task of Liu, Geng, Liu, Wang 2019, Fig. 19).

#include <optional>
#include <vector>

#include "proto/config.pb.h"
#include "slave/config/path.hpp"

namespace longreach {

enum class PathPhase { kAway, kReady, kUnderway, kDone };

/// Figures of an attempt. The errors are distances of the tool from the path.
struct PathFigures {
  double time_s = 0.0;
  double mean_error_m = 0.0;  // over the time
  double max_error_m = 0.0;
  int passed = 0;  // balls
};

class PathProgress {
 public:
  static constexpr double kAtStart_m = 0.005;   // from the first waypoint: an attempt may begin
  static constexpr double kAtTarget_m = 0.005;  // from the last waypoint: the target is reached

  /// `p_WE_start`: start position of the tool, m. Throws std::invalid_argument like Path.
  PathProgress(const PathConfig& config, const Vector3& p_WE_start);

  /// `t_s` must not decrease; `tool_m`: position of the tool in W. An attempt that has ended, or that has passed no ball, is
  /// followed by another one as soon as the tool is at the start again.
  void step(double t_s, const Vector3& tool_m);

  [[nodiscard]] PathPhase phase() const { return phase_; }
  /// Of the present attempt, or of the one that has ended.
  [[nodiscard]] PathFigures figures() const;
  [[nodiscard]] double error_m() const { return error_m_; }  // now
  [[nodiscard]] int balls() const { return static_cast<int>(balls_.size()); }

 private:
  /// Length of the path up to a ball, and how near the tool must be behind it.
  struct Ball {
    double along_m;
    double near_m;
  };

  Path path_;
  Vector3 start_m_, target_m_;
  std::vector<Ball> balls_{};
  PathPhase phase_ = PathPhase::kAway;
  std::optional<double> before_s_{};
  double error_m_ = 0.0, error_sum_ms_ = 0.0;
  PathFigures figures_{};
};

/// The path of a slave's scene, from the start pose of its robot; none: the scene has no path. Throws
/// std::invalid_argument if robot or path are invalid.
std::optional<PathProgress> path_of(const proto::Robot& robot, const proto::Scene& scene);

}  // namespace longreach
