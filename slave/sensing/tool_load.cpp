#include "slave/sensing/tool_load.hpp"

#include <cmath>
#include <numbers>

namespace longreach {

Wrench tool_wrench(const ToolLoadConfig& tool, const SensorMotion& motion) {
  const Vector3 &c = tool.com_m, &w = motion.angular, &turn = motion.angular_acceleration;
  const Vector3 at_com = motion.acceleration + turn.cross(c) + w.cross(w.cross(c));
  const Vector3 force = tool.mass_kg * (motion.gravity - at_com);
  const Vector3 spin = tool.inertia_kg_m2.cwiseProduct(w);
  return {c.cross(force) - tool.inertia_kg_m2.cwiseProduct(turn) - w.cross(spin), force};
}

SensorMotion SensorMotionEstimate::step(const Quaternion& q_WF, const Twist& V_WF, const Vector3& gravity_W,
                                        double bandwidth_hz, double dt) {
  if (last_ && dt > 0.0) {
    const double rate = 2.0 * std::numbers::pi * bandwidth_hz;
    const double share = rate > 0.0 ? -std::expm1(-rate * dt) : 1.0;
    acceleration_.linear += share * ((V_WF.linear - last_->linear) / dt - acceleration_.linear);
    acceleration_.angular += share * ((V_WF.angular - last_->angular) / dt - acceleration_.angular);
  }
  last_ = V_WF;
  const Quaternion q_FW = q_WF.conjugate();
  return {q_FW * gravity_W, q_FW * acceleration_.linear, q_FW * V_WF.angular, q_FW * acceleration_.angular};
}

void ToolCompensation::zero() {
  sum_ = {};
  time_s_ = 0.0;
  samples_ = 0;
  zeroing_ = config_.zero_s > 0.0;
}

void ToolCompensation::average(const Wrench& left, double dt) {
  if (!left.force.allFinite() || !left.moment.allFinite()) return;
  sum_.force += left.force;
  sum_.moment += left.moment;
  ++samples_;
  time_s_ += dt;
  if (time_s_ < config_.zero_s) return;
  bias_ = {sum_.moment / samples_, sum_.force / samples_};
  zeroing_ = false;
  zeroed_ = true;
}

Wrench ToolCompensation::step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt) {
  if (!(config_.tool.mass_kg > 0.0) && !(config_.zero_s > 0.0)) return reading;
  const Quaternion q_FW = q_WF.conjugate();
  const Wrench tool =
      tool_wrench(config_.tool, motion_.step(q_WF, V_WF, config_.gravity_m_per_s2, config_.bandwidth_hz, dt));
  const Wrench left{q_FW * reading.moment - tool.moment, q_FW * reading.force - tool.force};
  if (zeroing_) average(left, dt);
  return {q_WF * (left.moment - bias_.moment), q_WF * (left.force - bias_.force)};
}

}  // namespace longreach
