#pragma once
// What the gripper holds: its mass m and the first moment h = m c of its mass, c from the sensor's origin,
// from what it does to the force sensor while nothing is touched. In the sensor's frame, a the acceleration
// of its origin, ω, α its rotation, g gravity, b the sensor's bias:
//
//   f = m (g - a) - (α× + ω×ω×) h + b_f + noise,      τ = h × (g - a) + b_τ + noise
//
// A load hangs on a bond that spreads a push over some 10 ms, so that f and m a do not agree from sample to
// sample; what they sum to does. Both sides are smoothed alike (two lags of kLoadBand_s), and a Kalman filter
// of the constants m, h and of the bias, which drifts, takes them every kLoadUpdate_s. What the bond may
// still make of a force that changes counts as noise. Opened, the gripper holds nothing; closed, anything up
// to robot.load_max_kg.
//
// Pure; allocates nothing.

#include <Eigen/Core>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

struct SensorMotion {
  Vector3 gravity = Vector3::Zero();       // m/s²
  Vector3 acceleration = Vector3::Zero();  // of the sensor's origin, m/s²
  Vector3 angular = Vector3::Zero();       // rad/s
  Vector3 angular_acceleration = Vector3::Zero();
};

class LoadIdentifier {
 public:
  LoadIdentifier(const SensingConfig& sensing, double load_max_kg);
  void configure(const SensingConfig& sensing) { sensing_ = sensing; }

  /// A level. Another one than before: what is held is not known any more, or nothing is.
  void grip(bool closed);

  /// A sample, `dt` > 0 after the last, in the sensor's frame: what is left of it when the tool is taken out,
  /// with its bias. `free`: nothing is touched. What is not finite is left out.
  void step(const Wrench& left, const SensorMotion& motion, bool free, double dt);

  /// As it is held now; zero until something is known of it.
  [[nodiscard]] ToolLoadConfig load() const;
  [[nodiscard]] double sd_kg() const;
  /// Its mass is known to a tenth, or to be next to nothing.
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool holds() const;  // something that weighs, for certain
  /// As much mass may answer an acceleration otherwise than load() says, kg.
  [[nodiscard]] double uncertainty_kg() const;

 private:
  static constexpr int kStates = 10;  // m, h, b_f, b_τ
  using Row = Eigen::Matrix<double, kStates, 1>;
  /// What is smoothed: f, τ, g - a, and α× + ω×ω× by columns.
  using Signals = Eigen::Matrix<double, 18, 1>;

  void update(const Signals& smooth, const Signals& change, const Vector3& gravity);
  /// One equation: `row` . state = `value`, of variance `variance`.
  void take(const Row& row, double value, double variance);

  SensingConfig sensing_;
  double load_max_kg_;
  bool closed_ = false;
  bool begun_ = false;
  double since_s_ = 0.0, free_s_ = 0.0;
  Signals first_ = Signals::Zero(), second_ = Signals::Zero();
  Row state_ = Row::Zero();
  Eigen::Matrix<double, kStates, kStates> covariance_ = Eigen::Matrix<double, kStates, kStates>::Zero();
};

}  // namespace longreach
