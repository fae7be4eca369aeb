#pragma once
// Converts assignments by path into a complete, valid configuration, or returns why the change is refused.
// The schema defines when each field may change. The loop checks whether the robot is engaged, in the tick
// that applies the change.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "common/loop/mailbox.hpp"
#include "common/loop/stop_level.hpp"
#include "common/rpc/control_backend.hpp"

namespace longreach {

struct ConfigChange {
  std::unique_ptr<google::protobuf::Message> after;
  std::string not_while_engaged;  // fields that cannot be changed while engaged; empty if there are none
};

struct Configured {
  /// configuration with which the side started; an upper bound for the limits
  const google::protobuf::Message& start;
  const google::protobuf::Message& present;
};

/// Maximum number of assignments in one call, which limits the processing time.
inline constexpr std::size_t kAssignmentsMax = 256;
inline constexpr std::size_t kAssignmentsMaxBytes = 64 << 10;

/// Plans the change without applying it: `after` is a copy of the current configuration with the assignments
/// made.
std::variant<ConfigChange, Refusal> plan_change(const Configured& config, const Assignments& assignments);

enum class LoopAnswer { kDone, kEngaged, kOccupied };  // kOccupied: another master has control

/// Requests a stop from the loop. Returns none if the loop confirms the stop in time.
inline std::optional<Refusal> ask(StopLevel& stops) {
  if (stops.ask(std::chrono::milliseconds(1000))) return std::nullopt;
  return Refusal{Refusal::Kind::kUnavailable,
                 "the control loop did not respond within 1 s; the robot stops as soon as the loop resumes"};
}

/// Passes a command to the loop. Returns none if the loop carried it out. `not_while_engaged` is the member
/// of the ConfigChange; a refusal names these fields.
template <class Command>
std::optional<Refusal> post(Mailbox<Command, LoopAnswer>& mailbox, Command command,
                            const std::string& not_while_engaged = {}) {
  const auto answer = mailbox.post(std::move(command), std::chrono::milliseconds(1000));
  if (!answer) {
    return Refusal{Refusal::Kind::kUnavailable,
                   "the control loop did not respond within 1 s, so nothing was changed; try again"};
  }
  if (*answer == LoopAnswer::kDone) return std::nullopt;
  if (*answer == LoopAnswer::kOccupied) {
    return Refusal{Refusal::Kind::kPrecondition, "another master has control of the robot"};
  }
  return Refusal{Refusal::Kind::kPrecondition,
                 not_while_engaged + " cannot be changed while the robot is engaged; stop the robot first"};
}

}  // namespace longreach
