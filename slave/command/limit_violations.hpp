#pragma once
// Which limits the setpoints have exceeded, each by the ticks in which it was, and which one first.

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
  int joint = 0;                // that exceeded it, from 1; 0: none, or it is the tool's

  [[nodiscard]] std::uint64_t of(Limit limit) const { return ticks[static_cast<std::size_t>(limit)]; }
};

}  // namespace longreach
