#pragma once
// The deceleration a_b against a contact, and the speed v_a at which the tool may move in unknown space: there, it may
// touch the stiffest surface that the guard assumes (first_touch.hpp).
//   a_b = min(braking_max, 0.8 a_j),  a_b >= acceleration_max
// where a_j is the deceleration of the tool along its motion that the joints permit.

#include <algorithm>
#include <limits>
#include <optional>

#include "slave/config/command_config.hpp"
#include "slave/config/guard_config.hpp"

namespace longreach {

class ApproachSpeed {
 public:
  ApproachSpeed(const CommandConfig& command, const std::optional<FirstTouch>& touch) {
    configure(command, touch);
  }
  /// `touch` is unset if the force is not guarded; the speed is then not limited.
  void configure(const CommandConfig& command, const std::optional<FirstTouch>& touch) {
    command_ = command;
    touch_ = touch;
    braking_m_per_s2_ = most();
    find_speed();
  }

  /// Sets a_j > 0, which may be infinite.
  void permit(double joints_m_per_s2) {
    constexpr double kJointsShare = 0.8, kHigher = 1.2;
    braking_m_per_s2_ =
        std::clamp(kJointsShare * joints_m_per_s2, command_.acceleration_max_m_per_s2, most());
    // The search takes some microseconds, so small changes are ignored, but the speed is never too high.
    if (touch_ && (braking_m_per_s2_ < found_m_per_s2_ || braking_m_per_s2_ > kHigher * found_m_per_s2_))
      find_speed();
  }

  [[nodiscard]] double braking_m_per_s2() const { return braking_m_per_s2_; }
  /// Infinite if the speed is not limited.
  [[nodiscard]] double speed_m_per_s() const { return speed_m_per_s_; }

 private:
  [[nodiscard]] double most() const {
    return std::max(command_.braking_max_m_per_s2, command_.acceleration_max_m_per_s2);
  }
  void find_speed() {
    constexpr double kLower = 0.95;
    speed_m_per_s_ = std::numeric_limits<double>::infinity();
    if (!touch_) return;
    FirstTouch touch = *touch_;
    found_m_per_s2_ = touch.deceleration_m_per_s2 =
        std::max(kLower * braking_m_per_s2_, command_.acceleration_max_m_per_s2);
    speed_m_per_s_ = approach_speed(touch, command_.force_guard_n, command_.speed_max_m_per_s);
  }

  CommandConfig command_{};
  std::optional<FirstTouch> touch_{};
  double braking_m_per_s2_ = 0.0, found_m_per_s2_ = 0.0;
  double speed_m_per_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace longreach
