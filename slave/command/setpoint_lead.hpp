#pragma once
// Models how far the setpoint leads a tool that follows it through a servo (servo_lag.hpp), in position and
// rotation.

#include "slave/command/servo_lag.hpp"

namespace longreach {

class SetpointLead {
 public:
  explicit SetpointLead(double servo_hz) : place_(servo_hz), turn_(servo_hz) {}

  /// Restarts with the tool at rest at this setpoint.
  void reset(const Pose& X_WE) {
    place_.reset(X_WE.p);
    turn_.reset(turned_rad_);
    q_WE_ = X_WE.q;
    p_WE_ = X_WE.p;
    speed_m_per_s_ = 0.0;
    m_.setZero();
    rad_.setZero();
  }
  /// Processes a setpoint, `dt` > 0 s after the previous one.
  void step(const Pose& X_WE, double dt) {
    turned_rad_ += log_rotation(X_WE.q * q_WE_.conjugate());
    q_WE_ = X_WE.q;
    speed_m_per_s_ = (X_WE.p - p_WE_).norm() / dt;
    p_WE_ = X_WE.p;
    m_ = place_.step(X_WE.p, dt);
    rad_ = turn_.step(turned_rad_, dt);
  }
  /// Lead of the position in W, m.
  [[nodiscard]] const Vector3& m() const { return m_; }
  /// True if the setpoint is at rest (apart from rounding) and the remaining lead causes no measurable force.
  [[nodiscard]] bool still() const { return speed_m_per_s_ < 1e-4 && m_.norm() < 5e-6; }
  /// Lead of the rotation, a rotation vector in W, rad.
  [[nodiscard]] const Vector3& rad() const { return rad_; }

 private:
  ServoLag place_, turn_;
  Quaternion q_WE_ = Quaternion::Identity();
  Vector3 p_WE_ = Vector3::Zero();
  double speed_m_per_s_ = 0.0;
  Vector3 turned_rad_ = Vector3::Zero();  // accumulated rotation of the setpoint
  Vector3 m_ = Vector3::Zero(), rad_ = Vector3::Zero();
};

}  // namespace longreach
