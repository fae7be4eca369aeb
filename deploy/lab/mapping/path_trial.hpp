#pragma once
// One trial of the path-and-target task in the laboratory, with both nodes, simulated devices and hand, the
// Cartesian robot, and a link with delay only. The path consists of the segments of the path in the scene, in
// a different order. The surfaces of the scene are omitted, because only the path matters.

#include <cstdint>

#include "deploy/lab/mapping/path_operator.hpp"
#include "deploy/lab/trace.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct PathCase {
  PathStrategy strategy = PathStrategy::kHybrid;
  double rtt_s = 0.0;
  /// The display shows the commanded position of the robot instead of the delayed measured position.
  bool ghost = false;
  double near_sd = kNearSd;
  double size = 1.0;  // of the path, in that of the scene
  /// Amplitude of the rotation of the other handle, rad, which the operator does not intend.
  double turns_rad = 0.0;
  SimultaneousMotion simultaneous = SimultaneousMotion::kBoth;
  int person = 0, trial = 0;
  std::uint64_t seed = 1;  // all cases with the same seed have the same operators and paths
};

struct PathResult {
  bool finished = false;
  double time_s = 0.0;  // from the start until the tool is at rest at the last target
  /// Distance from the path, averaged over the distance travelled, so that waits do not count.
  double error_m = 0.0;
  /// Mean distance of the goal from a target when the operator moves on to the next one.
  double target_error_m = 0.0;
  double turned_rad = 0.0;  // mean rotation of the goal, which the operator does not intend
  int moves = 0, relocations = 0;
};

/// Returns `config` adapted to these trials, with the scene `path`. Throws ConfigError.
proto::LabConfig path_task_config(const proto::LabConfig& config);

PathResult run_path_trial(const proto::LabConfig& config, const PathCase& c, Trace* trace = nullptr);

/// Returns the plot coordinates of a point. The diagonal x = y = z, along which the path runs, points to the
/// right, and the direction z - x points upwards.
Eigen::Vector2d drawn(const Vector3& p_m);

/// Creates the trace of a trial. Its columns include the position of the tool relative to its start, in W and
/// in plot coordinates.
Trace path_trace(const std::filesystem::path& folder, std::string_view name);

/// Length of the path in units of the reach of the handle: the distance that the robot moves while the handle moves from its
/// home to the end of its workspace in position mode.
double reaches_of(const proto::LabConfig& config, const PathCase& c);

/// Returns the path of a trial.
PathCourse course_of(const proto::LabConfig& config, const PathCase& c);

}  // namespace longreach
