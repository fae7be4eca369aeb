#pragma once
// What the tool itself does to the force sensor that carries it, and its removal. With the tool's mass m,
// centre of mass c and inertia I about it, in the sensor's frame; g gravity, a the acceleration of the
// sensor's origin, ω, α its rotation, all in that frame:
//   a_c = a + α × c + ω × (ω × c)
//   f = m (g - a_c),   τ = c × f - I α - ω × I ω
// What is left when this is subtracted is what the environment does, and the sensor's bias. Zeroing takes the
// mean of that, over `zero_s` in which nothing is touched, for the bias.

#include <optional>

#include "common/spatial/spatial.hpp"
#include "slave/sensing/sensing_config.hpp"

namespace longreach {

struct SensorMotion {
  Vector3 gravity = Vector3::Zero();       // m/s²
  Vector3 acceleration = Vector3::Zero();  // of the sensor's origin, m/s²
  Vector3 angular = Vector3::Zero();       // rad/s
  Vector3 angular_acceleration = Vector3::Zero();
};

/// By the tool on the sensor, at its origin.
Wrench tool_wrench(const ToolLoadConfig& tool, const SensorMotion& motion);

/// Motion of a sensor from its velocities: their differences, smoothed with the sensor's bandwidth, so that
/// both are late by the same.
class SensorMotionEstimate {
 public:
  /// Velocity `V_WF` of the sensor's origin in W, `dt` after the last; bandwidth 0: not smoothed.
  /// Acceleration is zero at first.
  SensorMotion step(const Quaternion& q_WF, const Twist& V_WF, const Vector3& gravity_W, double bandwidth_hz,
                    double dt);

 private:
  std::optional<Twist> last_{};
  Twist acceleration_{};  // in W
};

/// Removes it.
class ToolCompensation {
 public:
  explicit ToolCompensation(const SensingConfig& config) : config_(config) {}
  void configure(const SensingConfig& config) { config_ = config; }

  /// Begins to average; nothing must be touched until it is over. What was zeroed before holds till then.
  /// Nothing where zero_s = 0.
  void zero();
  /// Something was touched: what was zeroed before stays.
  void abandon() { zeroing_ = false; }

  /// What the environment does to the tool, W: `reading` (in W) less tool and bias, at a sensor of
  /// orientation `q_WF` and velocity `V_WF`, `dt` after the last. What is not finite is handed on and
  /// averaged into nothing.
  Wrench step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt);

  /// False while the first zero is still being taken: what is left holds the bias.
  [[nodiscard]] bool ready() const { return zeroed_ || !zeroing_; }
  [[nodiscard]] bool zeroing() const { return zeroing_; }
  [[nodiscard]] const Wrench& bias() const { return bias_; }  // in the sensor's frame

 private:
  void average(const Wrench& left, double dt);

  SensingConfig config_;
  SensorMotionEstimate motion_{};
  Wrench bias_{}, sum_{};
  double time_s_ = 0.0;
  int samples_ = 0;
  bool zeroing_ = false, zeroed_ = false;
};

}  // namespace longreach
