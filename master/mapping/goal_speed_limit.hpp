#pragma once
// The speed limit of the goal in rate mode that follows from that of the robot: in unknown space the robot moves
// slowly, and its goal must not run ahead of it. The goal may lead a robot that enters unknown space by at most 20 mm
// until the report of it arrives, because the operator does not see the lead:
//   v <= v_a in unknown space,   v <= v_a + 20 mm / (round-trip time) elsewhere
// In position mode the goal follows the hand, which bounds its lead, and the surfaces that the hand feels are where
// the goal is.

#include <limits>
#include <optional>

#include "schema/config_master.hpp"

namespace longreach {

class GoalSpeedLimit {
 public:
  /// `approach_m_per_s`: the reported speed limit; 0: the robot is not limited.
  void on_report(double approach_m_per_s) {
    reported_m_per_s_ = approach_m_per_s;
    if (approach_m_per_s > 0.0) approach_m_per_s_ = approach_m_per_s;
  }
  /// Returns the limit, m/s; infinite if there is none.
  [[nodiscard]] double max_m_per_s(MotionMode mode, const std::optional<double>& rtt_s) const {
    constexpr double kLead_m = 0.02;
    constexpr double kUnlimited = std::numeric_limits<double>::infinity();
    if (mode == MotionMode::kPosition) return kUnlimited;
    if (reported_m_per_s_ > 0.0) return reported_m_per_s_;
    if (!(approach_m_per_s_ > 0.0) || !(rtt_s.value_or(0.0) > 0.0)) return kUnlimited;
    return approach_m_per_s_ + kLead_m / *rtt_s;
  }

 private:
  double reported_m_per_s_ = 0.0;
  double approach_m_per_s_ = 0.0;  // v_a, as last reported
};

}  // namespace longreach
