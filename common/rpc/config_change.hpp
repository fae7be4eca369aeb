#pragma once
// Converts assignments by path into a complete, valid configuration, or returns why the change is refused.
// The schema defines when each field may change. The loop checks whether the robot is engaged, in the tick
// that applies the change.

#include <memory>
#include <string>
#include <variant>

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

}  // namespace longreach
