#pragma once
// Lead of a setpoint over a tool that follows it through a servo of known bandwidth:
//   x' = 2π f (s - x),   lead = s - x
// The deflection of the tool by the contact is not modelled; that part of the lead does not become motion.

#include <cmath>
#include <numbers>

#include "common/spatial/spatial.hpp"

namespace longreach {

class ServoLag {
 public:
  /// `servo_hz` = 0: the servo is ideal, the lead zero.
  explicit ServoLag(double servo_hz) : rate_per_s_(2.0 * std::numbers::pi * servo_hz) {}

  /// The tool is at rest at this position.
  void reset(const Vector3& s_m) {
    x_m_ = s_m;
    begun_ = true;
  }

  /// The setpoint `s_m`, `dt` after the last one; the first one is the position of the tool. Returns the
  /// lead, m.
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
