#include "slave/sensing/tool_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/low_pass.hpp"

namespace longreach {
namespace {

constexpr double kLaterZero = 0.2;     // of the bound: drift
constexpr double kIrregular = 1.5;     // times the usual time between samples
constexpr double kUsual = 0.05;        // of a new one in the usual
constexpr double kUnsettled_s = 0.05;  // after such a gap, as long as that what comes late may come in pairs
constexpr double kUncertain_s = 0.02;  // longer than the filter that decides on a touch
constexpr double kQuick_s = 0.003;     // of the stiffest
constexpr double kToolUnknown = 0.15;  // of the mass of the tool
constexpr double kReach_m = 0.5;       // of a load's centre

}  // namespace

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
  const Vector3 mean_n = sum_.force / samples_;
  if (!zeroed_) first_n_ = clamp_norm(mean_n, limits_.zero_n);
  bias_ = {sum_.moment / samples_,
           first_n_ + clamp_norm(mean_n - first_n_, zeroed_ ? kLaterZero * limits_.zero_n : 0.0)};
  zeroing_ = first_ = false;
  zeroed_ = true;
}

void AccelerationUncertainty::step(const Twist& V_WF, double dt) {
  if (!last_ || !(dt > 0.0)) {
    last_ = V_WF;
    usual_s_ = dt;
    return;
  }
  if (!(usual_s_ > 0.0)) usual_s_ = dt;
  unsettled_s_ = dt > kIrregular * usual_s_ ? kUnsettled_s : unsettled_s_ - dt;
  const double kept = std::exp(-dt / kUncertain_s), over_s = std::min(dt, usual_s_);
  m_per_s2_ *= kept;
  rad_per_s2_ *= kept;
  if (unsettled_s_ > 0.0) {
    m_per_s2_ = std::max(m_per_s2_, (V_WF.linear - last_->linear).norm() / over_s);
    rad_per_s2_ = std::max(rad_per_s2_, (V_WF.angular - last_->angular).norm() / over_s);
  }
  usual_s_ += kUsual * (std::min(dt, kIrregular * usual_s_) - usual_s_);
  last_ = V_WF;
}

double ToolCompensation::tool_uncertainty_n() const {
  return config_.tool.mass_kg *
         (plausibility_.m_per_s2() + config_.tool.com_m.norm() * plausibility_.rad_per_s2());
}

double ToolCompensation::tool_uncertainty_nm() const {
  const ToolLoadConfig& tool = config_.tool;
  const double by_time =
      tool.com_m.norm() * tool_uncertainty_n() + tool.inertia_kg_m2.maxCoeff() * plausibility_.rad_per_s2();
  if (!tracks()) return by_time;
  return by_time + kToolUnknown * (tool.mass_kg * tool.com_m.norm() * tool_push_.m_per_s2() +
                                   tool.inertia_kg_m2.maxCoeff() * tool_turn_.m_per_s2());
}

double ToolCompensation::uncertainty_n() const {
  const double tool_n = tracks() ? kToolUnknown * config_.tool.mass_kg * tool_push_.m_per_s2() : 0.0;
  return tool_uncertainty_n() + std::min(tool_n + uncertain_kg_ * push_.m_per_s2(), limits_.load_n);
}

void ToolCompensation::follow_tool(const SensorMotion& motion, double dt) {
  const Vector3 &c = config_.tool.com_m, &w = motion.angular;
  const Vector3 at_com = motion.acceleration + motion.angular_acceleration.cross(c) + w.cross(w.cross(c));
  tool_m_per_s2_ -= std::expm1(-dt / kQuick_s) * (at_com.norm() - tool_m_per_s2_);
  tool_push_.step(tool_m_per_s2_, dt);
  tool_rad_per_s2_ -= std::expm1(-dt / kQuick_s) * (motion.angular_acceleration.norm() - tool_rad_per_s2_);
  tool_turn_.step(tool_rad_per_s2_ + w.squaredNorm(), dt);
}

void ToolCompensation::track(const Wrench& left, const Twist& V_WF, double dt, const LoadSample& sample) {
  const double speed = V_WF.linear.norm(), uncertain_n = uncertainty_n();
  tracker_.step({left.force - bias_.force, speed, sample.free, !closed_, uncertain_n, sample.touch_n, dt});
  if (!measures_moment(config_)) return;
  // Force and moment are zeroed at the same time, because the free moment depends on both.
  const Vector3 moment_n = (left.moment - bias_.moment) / kMomentLever_m;
  const double touch_n = sample.touch_nm / kMomentLever_m;
  moment_tracker_.step(
      {moment_n, speed, sample.free, !closed_, uncertain_n / sample.touch_n * touch_n, touch_n, dt});
}

double ToolCompensation::uncertainty_nm() const {
  const double by_load = kReach_m * uncertain_kg_ * (push_.m_per_s2() + kReach_m * turn_.m_per_s2());
  return tool_uncertainty_nm() + std::min(by_load, limits_.load_nm);
}

Wrench ToolCompensation::without_load(const Wrench& left, const LoadSample& sample, double dt) {
  const Pose& X_WF = sample.X_WF;
  const Pose before = X_WF_.value_or(X_WF);
  X_WF_ = X_WF;
  const Twist mean{log_rotation(X_WF.q * before.q.conjugate()) / dt, (X_WF.p - before.p) / dt};
  const SensorMotion motion = load_motion_.step(X_WF.q, mean, config_.gravity_m_per_s2, 0.0, dt);
  const auto follow = [&](SensorMotion& lag, double time_s) {
    const double share = low_pass_share(dt, time_s);
    lag.gravity = motion.gravity;
    lag.acceleration += share * (motion.acceleration - lag.acceleration);
    lag.angular = motion.angular;
    lag.angular_acceleration += share * (motion.angular_acceleration - lag.angular_acceleration);
  };
  if (closed_) bond_.step(left.force, motion.acceleration, sample.free, config_, dt);
  follow(slow_, bond_.lag_s());
  load_.step(left, slow_, sample.free, dt);
  // The filtered force forgets an earlier, less certain load no faster.
  const double now_kg = load_.uncertainty_kg();
  const double share = low_pass_share(dt, config_.filter_s);
  uncertain_kg_ = std::max(now_kg, uncertain_kg_ + share * (now_kg - uncertain_kg_));
  follow(quick_, kQuick_s);
  const double turned = quick_.angular_acceleration.norm() + quick_.angular.squaredNorm();
  push_.step((quick_.gravity - quick_.acceleration).norm() + kReach_m * turned, dt);
  turn_.step(turned, dt);
  const Wrench load = tool_wrench(load_.load(), slow_);
  return {left.moment - load.moment, left.force - load.force};
}

Wrench ToolCompensation::step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt,
                              const LoadSample& load) {
  const bool as_read = !(config_.tool.mass_kg > 0.0) && !(config_.zero_s > 0.0);
  if (as_read && !loads_ && !tracks()) return reading;
  plausibility_.step(V_WF, dt);
  const Quaternion q_FW = q_WF.conjugate();
  const SensorMotion motion = motion_.step(q_WF, V_WF, config_.gravity_m_per_s2, config_.bandwidth_hz, dt);
  const Wrench tool = tool_wrench(config_.tool, motion);
  Wrench left{q_FW * reading.moment - tool.moment, q_FW * reading.force - tool.force};
  if (loads_ && dt > 0.0) left = without_load(left, load, dt);
  if (tracks() && dt > 0.0) {
    follow_tool(motion, dt);
    track(left, V_WF, dt, load);
  }
  const Vector3 bias_n = bias_.force + tracker_.bias_n();
  const Vector3 bias_nm = bias_.moment + kMomentLever_m * moment_tracker_.bias_n();
  if (as_read && !(load_.load().mass_kg > 0.0) && bias_n.isZero(0.0) && bias_nm.isZero(0.0)) return reading;
  if (zeroing_) average(left, dt);
  return {q_WF * (left.moment - bias_nm), q_WF * (left.force - bias_n)};
}

}  // namespace longreach
