#pragma once
// What the tool itself does to the force sensor that carries it, and its removal. With the tool's mass m,
// centre of mass c and inertia I about it, in the sensor's frame; g gravity, a the acceleration of the
// sensor's origin, ω, α its rotation, all in that frame:
//   a_c = a + α × c + ω × (ω × c)
//   f = m (g - a_c),   τ = c × f - I α - ω × I ω
// What is left when this is subtracted is what the environment does, and the sensor's bias. Zeroing takes the
// mean of that, over `zero_s` in which nothing is touched, for the bias; no more of it than a bound, and
// later zeros no more than a fifth of that besides, so that it hides no greater force. Where samples came
// irregularly, the acceleration is known no better than from one of them to the next: the doubt is what the
// tool would do by it.

#include <limits>
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

/// Of an acceleration from velocities that come irregularly.
class AccelerationDoubt {
 public:
  /// V_WF, `dt` after the last.
  void step(const Twist& V_WF, double dt);
  [[nodiscard]] double m_per_s2() const { return m_per_s2_; }
  [[nodiscard]] double rad_per_s2() const { return rad_per_s2_; }

 private:
  std::optional<Twist> last_{};
  double usual_s_ = 0.0;
  double unsettled_s_ = 0.0;
  double m_per_s2_ = 0.0, rad_per_s2_ = 0.0;
};

/// Removes it.
class ToolCompensation {
 public:
  /// No force greater than `zero_max_n` is ever taken for a bias.
  explicit ToolCompensation(const SensingConfig& config,
                            double zero_max_n = std::numeric_limits<double>::infinity())
      : config_(config), zero_max_n_(zero_max_n), zeroing_(config.zero_s > 0.0), first_(zeroing_) {}
  void configure(const SensingConfig& config, double zero_max_n) {
    config_ = config;
    zero_max_n_ = zero_max_n;
    if (!(config.zero_s > 0.0)) abandon();
  }

  /// Begins to average; nothing must be touched until it is over. What was zeroed before holds till then.
  /// Nothing where zero_s = 0.
  void zero();
  /// Something was touched, or may be from now on: what was zeroed before stays.
  void abandon() { zeroing_ = first_ = false; }

  /// What the environment does to the tool, W: `reading` (in W) less tool and bias, at a sensor of
  /// orientation `q_WF` and velocity `V_WF`, `dt` after the last. What is not finite is handed on and
  /// averaged into nothing.
  Wrench step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt);

  /// False while the first zero is still being taken: what is left holds the bias.
  [[nodiscard]] bool ready() const { return !first_; }
  [[nodiscard]] bool zeroing() const { return zeroing_; }
  [[nodiscard]] const Wrench& bias() const { return bias_; }  // in the sensor's frame
  /// What of force and moment may be by an acceleration that is not known.
  [[nodiscard]] double doubt_n() const;
  [[nodiscard]] double doubt_nm() const;

 private:
  void average(const Wrench& left, double dt);

  SensingConfig config_;
  double zero_max_n_;
  SensorMotionEstimate motion_{};
  AccelerationDoubt doubt_{};
  Wrench bias_{}, sum_{};
  Vector3 first_n_ = Vector3::Zero();  // bias of the first zero
  double time_s_ = 0.0;
  int samples_ = 0;
  bool zeroing_, first_, zeroed_ = false;
};

}  // namespace longreach
