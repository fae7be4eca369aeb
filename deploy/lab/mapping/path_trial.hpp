#pragma once
// One trial of the path and target task in the laboratory: both nodes, simulated devices and hand, the
// Cartesian robot, a link that does nothing but delay. The scene's path, reordered; what stands beside it is
// not built: the way alone counts.

#include <cstdint>

#include "deploy/lab/mapping/path_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct PathCase {
  PathStrategy strategy = PathStrategy::kHybrid;
  double rtt_s = 0.0;
  bool ghost = false;  // he looks at where the robot is told to be, instead of where it is shown
  double near_sd = kNearSd;
  int person = 0, trial = 0;
  std::uint64_t seed = 1;  // person and way are the same in every case of a seed
};

struct PathResult {
  bool finished = false;
  double time_s = 0.0;   // from his first look till the tool stands at the last target
  double error_m = 0.0;  // distance from the way, mean over what the tool has gone: waits count nothing
  double target_error_m = 0.0;  // of the goal from a target where he leaves it behind, mean
  int moves = 0, relocations = 0;
};

/// A configuration for these trials: scene `path`. Throws ConfigError.
proto::LabConfig path_task_config(const proto::LabConfig& config);

PathResult run_path_trial(const proto::LabConfig& config, const PathCase& c, Trace* trace = nullptr);

/// A place as the plots show it: the diagonal x = y = z to the right, so that the way goes on, z - x up.
Eigen::Vector2d drawn(const Vector3& p_m);

/// The columns of the trace: place of the tool from its start, also as the plots show it.
Trace path_trace(const std::filesystem::path& folder, std::string_view name);

/// The way of a person's trial.
PathCourse course_of(const proto::LabConfig& config, const PathCase& c);

}  // namespace longreach
