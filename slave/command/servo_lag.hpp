#pragma once
// Models how far a setpoint leads a tool that follows it through a first-order servo of bandwidth f:
//   x' = 2π f (s - x),   lead = s - x
// The deflection of the tool by the contact is not modelled, because that part of the lead never becomes
// motion.

#include <cmath>
#include <numbers>

#include "common/spatial/spatial.hpp"

namespace longreach {

class ServoLag {
 public:
  /// `servo_hz`: bandwidth; 0: the servo is ideal, and the lead is zero.
  explicit ServoLag(double servo_hz) : rate_per_s_(2.0 * std::numbers::pi * servo_hz) {}

  /// Restarts with the tool at rest at `s_m`.
  void reset(const Vector3& s_m) {
    x_m_ = s_m;
    begun_ = true;
  }

  /// Processes the setpoint `s_m`, `dt` s after the previous setpoint; the first setpoint is also taken as
  /// the position of the tool. Returns the lead, m.
  Vector3 step(const Vector3& s_m, double dt) {
    if (!begun_ || !(rate_per_s_ > 0.0)) x_m_ = s_m;
    begun_ = true;
    x_m_ -= std::expm1(-rate_per_s_ * dt) * (s_m - x_m_);
    return s_m - x_m_;
  }

 private:
  double rate_per_s_;
  Vector3 x_m_ = Vector3::Zero();
  bool begun_ = false;
};

}  // namespace longreach
