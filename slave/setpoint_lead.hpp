#pragma once
// How far the setpoint is ahead of a tool that follows it through a servo (servo_lag.hpp), in place and in
// rotation.

#include "slave/command/servo_lag.hpp"

namespace longreach {

class SetpointLead {
 public:
  explicit SetpointLead(double servo_hz) : place_(servo_hz), turn_(servo_hz) {}

  /// The tool rests at this setpoint.
  void reset(const Pose& X_WE) {
    place_.reset(X_WE.p);
    turn_.reset(turned_rad_);
    q_WE_ = X_WE.q;
    m_.setZero();
    rad_.setZero();
  }
  /// The setpoint, `dt` after the last.
  void step(const Pose& X_WE, double dt) {
    turned_rad_ += log_rotation(X_WE.q * q_WE_.conjugate());
    q_WE_ = X_WE.q;
    m_ = place_.step(X_WE.p, dt);
    rad_ = turn_.step(turned_rad_, dt);
  }
  [[nodiscard]] const Vector3& m() const { return m_; }
  [[nodiscard]] const Vector3& rad() const { return rad_; }

 private:
  ServoLag place_, turn_;
  Quaternion q_WE_ = Quaternion::Identity();
  Vector3 turned_rad_ = Vector3::Zero();  // sum of the setpoint's turns
  Vector3 m_ = Vector3::Zero(), rad_ = Vector3::Zero();
};

}  // namespace longreach
