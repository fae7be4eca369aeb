#pragma once
// Counts, for each limit, the ticks in which the setpoints exceeded it, and records the first violation.

#include <array>
#include <cstdint>
#include <string_view>

#include "common/schema/visit.hpp"

namespace longreach {

enum class Limit : std::uint8_t {
  kJointPosition,
  kJointSpeed,
  kJointAcceleration,
  kJointJerk,
  kToolSpeed,
  kToolAcceleration,
  kCount
};

/// Returns the name of a limit, for example "joint speed"; "none" for kCount.
std::string_view name_of(Limit limit);

struct LimitViolations {
  std::array<std::uint64_t, static_cast<std::size_t>(Limit::kCount)> ticks{};
  Limit first = Limit::kCount;  // limit that was violated first; kCount: none
  int joint = 0;                // joint of the first violation, from 1; 0: none, or a limit of the tool

  [[nodiscard]] std::uint64_t of(Limit limit) const { return ticks[static_cast<std::size_t>(limit)]; }
};

template <class Visitor, Is<LimitViolations> S>
void visit_fields(Visitor& visit, S& s) {
  visit("joint_position", s.ticks[0]);
  visit("joint_speed", s.ticks[1]);
  visit("joint_acceleration", s.ticks[2]);
  visit("joint_jerk", s.ticks[3]);
  visit("tool_speed", s.ticks[4]);
  visit("tool_acceleration", s.ticks[5]);
}

}  // namespace longreach
