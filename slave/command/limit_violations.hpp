#pragma once
// Counts the ticks in which the setpoints exceeded each limit, and records the first violation.

#include <array>
#include <cstdint>
#include <string_view>

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

/// "joint speed"
std::string_view name_of(Limit limit);

struct LimitViolations {
  std::array<std::uint64_t, static_cast<std::size_t>(Limit::kCount)> ticks{};
  Limit first = Limit::kCount;  // kCount: none
  int joint = 0;                // joint of that violation, from 1; 0: none, or the tool

  [[nodiscard]] std::uint64_t of(Limit limit) const { return ticks[static_cast<std::size_t>(limit)]; }
};

}  // namespace longreach
