#pragma once
// Effect of the tool on the force sensor that carries it, and its compensation. All vectors are in the frame
// of the sensor. With the mass m of the tool, its centre of mass c, its inertia I about c, gravity g, the
// acceleration a of the origin of the sensor, and the angular velocity ω and acceleration α of the sensor,
//   a_c = a + α × c + ω × (ω × c)
//   f = m (g - a_c),   τ = c × f - I α - ω × I ω
// The remainder of the reading is the wrench of the environment plus the bias of the sensor. Zeroing
// estimates the bias as the mean of the remainder over `zero_s` without contact, limited by a bound. Zeroing
// the sensor again may change the bias by at most a fifth of the bound, so that it cannot hide a larger
// force.
//
// If the samples are irregular, the uncertainty of the acceleration is its change between samples; the
// uncertainty of the force is the effect of these changes on the tool. The load in the gripper, if it is
// known (load_identifier.hpp), is compensated in the same way, with an acceleration that has passed through the
// lag of the bond (bond_lag.hpp). Its unknown part is treated as uncertainty while the tool accelerates and for
// at least 0.3 s more. The uncertainty of the mass decreases no faster than the filtered force that decides on
// a touch. If the touch threshold is derived, the biases of force and moment are also tracked in free motion with an
// open gripper (bias_tracker.hpp), and the mass of the tool is assumed to be known within 15 %. The moment is tracked
// as the force that causes it at a lever of 0.1 m, so its usual drift is 0.1 m times that of the force.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "common/spatial/spatial.hpp"
#include "slave/config/command_config.hpp"
#include "slave/config/sensing_config.hpp"
#include "slave/sensing/bias_tracker.hpp"
#include "slave/sensing/bond_lag.hpp"
#include "slave/sensing/load_identifier.hpp"

namespace longreach {

/// Returns the wrench of the tool on the sensor, at the origin of the sensor.
Wrench tool_wrench(const ToolLoadConfig& tool, const SensorMotion& motion);

/// Estimates the motion of a sensor from differences of its velocity. The motion is filtered with the
/// bandwidth of the sensor, so that motion and reading have the same delay.
class SensorMotionEstimate {
 public:
  /// Processes the velocity `V_WF` of the origin of the sensor in W, `dt` s after the previous one.
  /// `bandwidth_hz` = 0: not filtered. The first acceleration is zero.
  SensorMotion step(const Quaternion& q_WF, const Twist& V_WF, const Vector3& gravity_W, double bandwidth_hz,
                    double dt);

 private:
  std::optional<Twist> last_{};
  Twist acceleration_{};  // in W
};

/// Uncertainty of an acceleration that is computed from irregularly sampled velocities.
class AccelerationUncertainty {
 public:
  /// Processes the velocity `V_WF`, `dt` s after the previous one.
  void step(const Twist& V_WF, double dt);
  [[nodiscard]] double m_per_s2() const { return m_per_s2_; }
  [[nodiscard]] double rad_per_s2() const { return rad_per_s2_; }

 private:
  std::optional<Twist> last_{};
  double usual_s_ = 0.0;
  double unsettled_s_ = 0.0;
  double m_per_s2_ = 0.0, rad_per_s2_ = 0.0;
};

/// Lever at which a moment is compared with a force.
constexpr double kMomentLever_m = 0.1;

/// Returns the configuration of a sensor that measures the moment as a force at kMomentLever_m.
inline SensingConfig at_moment_lever(SensingConfig c) {
  c.force_noise_n = c.moment_noise_nm / kMomentLever_m;
  c.force_resolution_n = c.moment_resolution_nm / kMomentLever_m;
  c.force_drift_n = c.moment_drift_nm / kMomentLever_m;
  return c;
}

/// Maximum acceleration during the last 0.3 to 0.4 s.
class AccelerationPeak {
 public:
  void step(double m_per_s2, double dt) {
    age_s_ += dt;
    if (age_s_ >= kPart_s) {
      std::shift_right(most_.begin(), most_.end(), 1);
      most_[0] = age_s_ = 0.0;
    }
    most_[0] = std::max(most_[0], m_per_s2);
  }
  [[nodiscard]] double m_per_s2() const { return *std::max_element(most_.begin(), most_.end()); }

 private:
  static constexpr double kPart_s = 0.1;
  std::array<double, 4> most_{};  // in the parts of this time, the latest first
  double age_s_ = 0.0;            // of the latest part
};

/// Sample for identifying a load.
struct LoadSample {
  bool free = false;  // there is no contact
  // Pose of the sensor. Its motion is computed from displacements, because a reported speed may be the
  // instantaneous speed of a servo that stops between two setpoints.
  Pose X_WF{};
  double touch_n = 0.3, touch_nm = 0.03;  // touch thresholds
};

/// Upper bounds on the force that may be treated as bias, and on the force of an unknown load that is not
/// treated as a contact. The guards receive every force beyond these bounds.
struct CompensationLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double guard_n = kNone, guard_nm = kNone;  // of the guards, which bound the tracked biases
  double zero_n = kNone;
  double load_n = kNone, load_nm = kNone;

  /// Returns the limits that correspond to the force and moment guards. A load whose inertial force is at most
  /// 0.75 of the guard can be dragged; the spring force of the bond to the gripper overshoots that force.
  static CompensationLimits of(const CommandConfig& c) {
    constexpr double kOvershoot = 1.25;
    return {c.force_guard_n, c.moment_guard_nm, 0.5 * c.force_guard_n,
            kLoadGuardShare * kOvershoot * c.force_guard_n, kLoadGuardShare * kOvershoot * c.moment_guard_nm};
  }
};

/// Compensates for tool, load and bias.
class ToolCompensation {
 public:
  explicit ToolCompensation(const SensingConfig& config, const CompensationLimits& limits = {},
                            double load_max_kg = 0.0)
      : config_(config),
        limits_(limits),
        load_(config, load_max_kg),
        tracker_(expected_drift_n(config), limits.guard_n),
        moment_tracker_(expected_drift_n(at_moment_lever(config)), limits.guard_nm / kMomentLever_m),
        zeroing_(config.zero_s > 0.0),
        first_(zeroing_),
        loads_(load_max_kg > 0.0) {}
  void configure(const SensingConfig& config, const CompensationLimits& limits) {
    config_ = config;
    limits_ = limits;
    load_.configure(config);
    tracker_.configure(expected_drift_n(config), limits.guard_n);
    moment_tracker_.configure(expected_drift_n(at_moment_lever(config)), limits.guard_nm / kMomentLever_m);
    if (!(config.zero_s > 0.0)) abandon();
  }

  /// Starts zeroing the sensor by averaging the readings. There must be no contact until zeroing is complete;
  /// the previous zero is used until then. Does nothing if zero_s = 0.
  void zero();
  /// Stops averaging and keeps the previous zero. Call this when there is contact or contact becomes
  /// possible.
  void abandon() { zeroing_ = first_ = false; }

  /// Returns the wrench of the environment on the tool, in W, which is `reading` (in W) without the effects
  /// of tool, load and bias. `q_WF` and `V_WF` are the orientation and velocity of the sensor; `dt` s have
  /// passed since the previous reading. Values that are not finite are passed through and not averaged.
  Wrench step(const Wrench& reading, const Quaternion& q_WF, const Twist& V_WF, double dt,
              const LoadSample& load = {});
  /// Sets the state of the gripper.
  void grip(bool closed) {
    load_.grip(closed);
    if (closed != closed_) bond_ = {};
    closed_ = closed;
  }
  /// Returns true if the load in the gripper is known or the gripper is empty.
  [[nodiscard]] bool load_known() const { return !closed_ || !loads_ || load_.known(); }
  [[nodiscard]] const BiasTracker& tracker() const { return tracker_; }
  /// Of the moment, as a force at kMomentLever_m.
  [[nodiscard]] const BiasTracker& moment_tracker() const { return moment_tracker_; }

  /// Returns false during the first zeroing, because the result then contains the bias.
  [[nodiscard]] bool ready() const { return !first_; }
  [[nodiscard]] bool zeroing() const { return zeroing_; }
  [[nodiscard]] const Wrench& bias() const { return bias_; }  // bias in the frame of the sensor
  [[nodiscard]] const LoadIdentifier& load() const { return load_; }
  /// Upper bound on the mass of the load, if it is known that the gripper holds one; otherwise 0.
  [[nodiscard]] double load_kg() const { return load_.holds() ? load_.bound_kg() : 0.0; }
  /// Magnitude of the force, and of the moment, that an uncertain acceleration or load may cause.
  [[nodiscard]] double uncertainty_n() const;
  [[nodiscard]] double uncertainty_nm() const;

 private:
  void average(const Wrench& left, double dt);
  [[nodiscard]] double tool_uncertainty_n() const;
  [[nodiscard]] double tool_uncertainty_nm() const;
  [[nodiscard]] bool tracks() const { return !(config_.touch_n > 0.0); }
  void follow_tool(const SensorMotion& motion, double dt);
  void track(const Wrench& left, const Twist& V_WF, double dt, const LoadSample& sample);
  Wrench without_load(const Wrench& left, const LoadSample& load, double dt);

  SensingConfig config_;
  CompensationLimits limits_;
  SensorMotionEstimate motion_{}, load_motion_{};
  AccelerationUncertainty plausibility_{};
  LoadIdentifier load_;
  BondLag bond_{};
  double uncertain_kg_ = 0.0;         // uncertainty of the load in the filtered force
  std::optional<Pose> X_WF_{};        // pose of the sensor at the previous sample
  AccelerationPeak push_{}, turn_{};  // peaks that determine the uncertainty of the load
  BiasTracker tracker_, moment_tracker_;
  AccelerationPeak tool_push_{}, tool_turn_{};
  double tool_m_per_s2_ = 0.0;    // filtered acceleration of the tool's centre of mass
  double tool_rad_per_s2_ = 0.0;  // filtered angular acceleration
  /// Motion as transmitted by the bond, and as transmitted by the stiffest possible bond.
  SensorMotion slow_{}, quick_{};
  Wrench bias_{}, sum_{};
  Vector3 first_n_ = Vector3::Zero();  // bias found by the first zeroing
  double time_s_ = 0.0;
  int samples_ = 0;
  bool zeroing_, first_, loads_, zeroed_ = false, closed_ = false;
};

}  // namespace longreach
