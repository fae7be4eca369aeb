#pragma once
// From assignments by path to a complete, valid configuration, or why not. What may change when is decided by
// the schema; whether the robot is engaged is known only to the loop, at the tick that takes the change.

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
  std::string not_while_engaged;  // fields that forbid the change while engaged, in words; empty: none
};

struct Configured {
  const google::protobuf::Message& start;  // what the side was started with: the ceiling of its limits
  const google::protobuf::Message& present;
};

/// Most that one call may bring, so that it is worked out in a moment.
inline constexpr std::size_t kAssignmentsMax = 256;
inline constexpr std::size_t kAssignmentsMaxBytes = 64 << 10;

/// Nothing has changed yet: `after` is a copy of the present configuration with the assignments.
std::variant<ConfigChange, Refusal> plan_change(const Configured& config, const Assignments& assignments);

enum class LoopAnswer { kDone, kEngaged, kOccupied };  // kOccupied: another master is there

/// Asks the loop to stop.
inline std::optional<Refusal> ask(StopLevel& stops) {
  if (stops.ask(std::chrono::milliseconds(1000))) return std::nullopt;
  return Refusal{Refusal::Kind::kUnavailable,
                 "the control loop did not respond within 1 s; it stops as soon as it resumes"};
}

/// Hands a command to the loop. `not_while_engaged`: of the change, for the refusal.
template <class Command>
std::optional<Refusal> post(Mailbox<Command, LoopAnswer>& mailbox, Command command,
                            const std::string& not_while_engaged = {}) {
  const auto answer = mailbox.post(std::move(command), std::chrono::milliseconds(1000));
  if (!answer) {
    return Refusal{Refusal::Kind::kUnavailable,
                   "the control loop did not respond within 1 s; nothing has changed, try again"};
  }
  if (*answer == LoopAnswer::kDone) return std::nullopt;
  if (*answer == LoopAnswer::kOccupied) {
    return Refusal{Refusal::Kind::kPrecondition, "another master has control of the robot"};
  }
  return Refusal{Refusal::Kind::kPrecondition,
                 not_while_engaged + " cannot be changed while the robot is engaged; stop it first"};
}

}  // namespace longreach
