#pragma once
// One trial of a task by hand, judged from the frames of the master.

#include <memory>
#include <string>

#include "deploy/cli/invocation.hpp"
#include "deploy/cli/side_client.hpp"
#include "proto/control.pb.h"

namespace longreach {

constexpr const char* kPathColumns =
    "mode,rtt_s,scale,kv_per_s,finished,time_s,mean_error_m,max_error_m,balls_passed,balls,repositionings,holds,"
    "tool_force_max_n,hand_force_max_n";
constexpr const char* kDockColumns =
    "mode,rtt_s,scale,kv_per_s,finished,time_s,grasp_s,seat_s,position_error_m,angle_error_rad,repositionings,holds,"
    "seat_force_n,tool_force_max_n,hand_force_max_n";

class TaskTrial {
 public:
  TaskTrial() = default;
  TaskTrial(const TaskTrial&) = delete;
  TaskTrial& operator=(const TaskTrial&) = delete;
  virtual ~TaskTrial() = default;

  /// Returns false at the end of the trial.
  virtual bool step(const proto::Frame& frame) = 0;
  [[nodiscard]] virtual bool begun() const = 0;
  [[nodiscard]] virtual bool finished() const = 0;
  /// Figures of the attempt, separated by commas, in the order of kPathColumns or kDockColumns.
  [[nodiscard]] virtual std::string cells() const = 0;
  [[nodiscard]] virtual std::string sentence() const = 0;
};

/// The trial of a task in the scene of the slave. Throws SideError if the scene does not have this task.
std::unique_ptr<TaskTrial> path_trial(const Options& options, const TaskCommand& command, SideClient& slave);
std::unique_ptr<TaskTrial> dock_trial(const Options& options, const TaskCommand& command, SideClient& slave);

}  // namespace longreach
