#pragma once
// Identifies the load in the gripper from its effect on the force sensor when there is no contact: its mass m
// and first moment h = m c, where c is its centre of mass relative to the origin of the sensor. In the frame
// of the sensor, with the acceleration a of its origin, its angular velocity ω and acceleration α, gravity g
// and the bias b,
//
//   f = m (g - a) - (α× + ω×ω×) h + b_f + noise,      τ = h × (g - a) + b_τ + noise
//
// The bond that holds a load spreads an impulse over up to 20 ms, so the integrals of f and m a agree, but not
// the individual samples. Therefore the acceleration of the load is used, as far as it is known
// (bond_lag.hpp), both sides are filtered in the same way (two first-order filters with the time constant
// kLoadBand_s), and a Kalman filter for the constants m and h and for the drifting bias processes them every
// kLoadUpdate_s. The filters start 0.3 s after a touch or a change of the gripper. The remaining effect of the
// bond on a changing force is treated as noise. An open gripper is empty; a closed one may hold up to
// robot.load_max_kg.
//
// Pure; allocates nothing.

#include <Eigen/Core>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

struct SensorMotion {
  Vector3 gravity = Vector3::Zero();               // m/s²
  Vector3 acceleration = Vector3::Zero();          // acceleration of the origin of the sensor, m/s²
  Vector3 angular = Vector3::Zero();               // rad/s
  Vector3 angular_acceleration = Vector3::Zero();  // rad/s²
};

class LoadIdentifier {
 public:
  LoadIdentifier(const SensingConfig& sensing, double load_max_kg);
  void configure(const SensingConfig& sensing) { sensing_ = sensing; }

  /// Sets the state of the gripper. After a change, the load is unknown (closed) or absent (open).
  void grip(bool closed);

  /// Processes a sample, `dt` > 0 s after the previous one, in the frame of the sensor: `left` is the reading
  /// without the tool, but with the bias; `motion` has passed through the lag of the bond. `free`: there is no
  /// contact. Samples that are not finite are skipped.
  void step(const Wrench& left, const SensorMotion& motion, bool free, double dt);

  /// Returns the current load; zero until it is identified.
  [[nodiscard]] ToolLoadConfig load() const;
  /// Standard deviation of the mass, kg.
  [[nodiscard]] double sd_kg() const;
  /// True if the mass is significant, which is at least 3 standard deviations, or known() to be negligible.
  [[nodiscard]] bool measured() const { return known() || load().mass_kg > 0.0; }
  /// True if the mass is known within 10 % or is known to be negligible.
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool holds() const;  // the gripper holds a load of significant mass
  /// Upper bound on the mass, kg.
  [[nodiscard]] double bound_kg() const;
  /// Uncertainty of load(), kg: 0.3 of it for what bond and sensor do, and independently 3 standard deviations.
  [[nodiscard]] double uncertainty_kg() const;

 private:
  static constexpr int kStates = 10;  // m, h, b_f, b_τ
  using Row = Eigen::Matrix<double, kStates, 1>;
  /// Filtered signals: f, τ, g - a, and the columns of α× + ω×ω×.
  using Signals = Eigen::Matrix<double, 18, 1>;

  struct Smoothed {
    Signals signals, change;  // the signals and their time derivatives
    Vector3 gravity;
    double between_s;  // time between samples
  };
  void update(const Smoothed& at);
  /// Updates the Kalman filter with the equation `row`·state = `value`, which has noise with this variance.
  void take(const Row& row, double value, double variance);

  SensingConfig sensing_;
  double load_max_kg_;
  bool closed_ = false;
  double since_s_ = 0.0, free_s_ = 0.0;
  int samples_ = 0;  // number of samples since the last update
  Signals first_ = Signals::Zero(), second_ = Signals::Zero();
  Row state_ = Row::Zero();
  Eigen::Matrix<double, kStates, kStates> covariance_ = Eigen::Matrix<double, kStates, kStates>::Zero();
};

}  // namespace longreach
