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
// tool would do by it. What the gripper holds is taken out likewise, as far as it is known
// (load_identifier.hpp), by an acceleration that is smoothed as a bond does; what of it is not known is in
// doubt while the tool accelerates, and 0.3 s longer.

#include <limits>
#include <optional>

#include "common/spatial/spatial.hpp"
#include "slave/config/command_config.hpp"
#include "slave/config/sensing_config.hpp"
#include "slave/sensing/load_identifier.hpp"

namespace longreach {

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
class AccelerationUncertainty {
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

/// The greatest that an acceleration was in the last 0.3 s.
class AccelerationPeak {
 public:
  void step(double m_per_s2, double dt) {
    age_s_ += dt;
    if (m_per_s2 < most_ && age_s_ < kLasts_s) return;
    most_ = m_per_s2;
    age_s_ = 0.0;
  }
  [[nodiscard]] double m_per_s2() const { return most_; }

 private:
  static constexpr double kLasts_s = 0.3;
  double most_ = 0.0, age_s_ = 0.0;
};

/// What a load may be learnt from.
struct LoadSample {
  bool free = false;  // nothing is touched
  // Of the sensor: a load is moved by ways. A speed that is told may be that of an instant, of a servo that
  // comes to rest between two setpoints.
  Pose X_WF{};
};

/// What is never exceeded: by a force that is taken for a bias, and by what a load that is not known may do
/// without being a contact, so that the guards see every force.
struct CompensationLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double zero_n = kNone;
  double load_n = kNone, load_nm = kNone;

  /// By the guards of force and moment.
  static CompensationLimits of(const CommandConfig& c) {
    return {0.5 * c.force_guard_n, 0.75 * c.force_guard_n, 0.75 * c.moment_guard_nm};
  }
};

/// Removes it.
class ToolCompensation {
 public:
  explicit ToolCompensation(const SensingConfig& config, const CompensationLimits& limits = {},
                            double load_max_kg = 0.0)
      : config_(config),
        limits_(limits),
        load_(config, load_max_kg),
        zeroing_(config.zero_s > 0.0),
        first_(zeroing_),
        loads_(load_max_kg > 0.0) {}
  void configure(const SensingConfig& config, const CompensationLimits& limits) {
    config_ = config;
    limits_ = limits;
    load_.configure(config);
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
  Wrench step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt,
              const LoadSample& load = {});
  /// The gripper is closed, a level.
  void grip(bool closed) { load_.grip(closed); }

  /// False while the first zero is still being taken: what is left holds the bias.
  [[nodiscard]] bool ready() const { return !first_; }
  [[nodiscard]] bool zeroing() const { return zeroing_; }
  [[nodiscard]] const Wrench& bias() const { return bias_; }  // in the sensor's frame
  [[nodiscard]] const LoadIdentifier& load() const { return load_; }
  /// What of force and moment may be by an acceleration or a load that is not known.
  [[nodiscard]] double uncertainty_n() const;
  [[nodiscard]] double uncertainty_nm() const;

 private:
  void average(const Wrench& left, double dt);
  [[nodiscard]] double tool_uncertainty_n() const;
  Wrench without_load(const Wrench& left, const LoadSample& load, double dt);

  SensingConfig config_;
  CompensationLimits limits_;
  SensorMotionEstimate motion_{}, load_motion_{};
  AccelerationUncertainty plausibility_{};
  LoadIdentifier load_;
  std::optional<Pose> X_WF_{};        // at the last sample of a load
  AccelerationPeak push_{}, turn_{};  // of a load
  SensorMotion slow_{}, quick_{};     // as a bond hands it on; as it may at the fastest
  Wrench bias_{}, sum_{};
  Vector3 first_n_ = Vector3::Zero();  // bias of the first zero
  double time_s_ = 0.0;
  int samples_ = 0;
  bool zeroing_, first_, loads_, zeroed_ = false;
};

}  // namespace longreach
