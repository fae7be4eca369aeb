#pragma once
// One trial of the path and target task in the laboratory: both nodes, simulated devices and hand, the
// Cartesian robot, a link that only delays. The path of the scene, reordered; other surfaces are not built,
// because only the path matters.

#include <cstdint>

#include "deploy/lab/mapping/path_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct PathCase {
  PathStrategy strategy = PathStrategy::kHybrid;
  double rtt_s = 0.0;
  /// the display shows the commanded position of the robot instead of the delayed measured one
  bool ghost = false;
  double near_sd = kNearSd;
  int person = 0, trial = 0;
  std::uint64_t seed = 1;  // person and path are the same in every case of a seed
};

struct PathResult {
  bool finished = false;
  double time_s = 0.0;   // from the first look until the tool is at rest at the last target
  double error_m = 0.0;  // distance from the path, mean over the distance of the tool: waits do not count
  double target_error_m = 0.0;  // distance of the goal from a target when the operator continues, mean
  int moves = 0, relocations = 0;
};

/// Returns a configuration for these trials: scene `path`. Throws ConfigError.
proto::LabConfig path_task_config(const proto::LabConfig& config);

PathResult run_path_trial(const proto::LabConfig& config, const PathCase& c, Trace* trace = nullptr);

/// Coordinates of a point in the plots: the diagonal x = y = z to the right, in the direction of the path, z
/// - x up.
Eigen::Vector2d drawn(const Vector3& p_m);

/// The columns of the trace: position of the tool from its start, also in plot coordinates.
Trace path_trace(const std::filesystem::path& folder, std::string_view name);

/// The path of a person's trial.
PathCourse course_of(const proto::LabConfig& config, const PathCase& c);

}  // namespace longreach
