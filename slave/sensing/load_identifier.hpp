#pragma once
// Identifies the load in the gripper: its mass m and the first moment h = m c, c from the origin of the
// sensor, from its effect on the force sensor without contact. In the frame of the sensor, a the acceleration
// of its origin, ω, α its rotation, g gravity, b the bias of the sensor:
//
//   f = m (g - a) - (α× + ω×ω×) h + b_f + noise,      τ = h × (g - a) + b_τ + noise
//
// A load is held by a bond that spreads a push over some 10 ms, so that f and m a do not agree from sample to
// sample, but their integrals do. Both sides are filtered equally (two lags of kLoadBand_s), and a Kalman
// filter of the constants m, h and of the drifting bias processes them every kLoadUpdate_s. The remaining
// effect of the bond on a changing force is treated as noise. An open gripper holds nothing; a closed one
// anything up to robot.load_max_kg.
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

  /// State of the gripper. A change makes the load unknown, or absent.
  void grip(bool closed);

  /// A sample, `dt` > 0 after the last one, in the frame of the sensor: the reading minus the tool, with its
  /// bias. `free`: there is no contact. Samples that are not finite are skipped.
  void step(const Wrench& left, const SensorMotion& motion, bool free, double dt);

  /// The present load; zero until it is identified.
  [[nodiscard]] ToolLoadConfig load() const;
  [[nodiscard]] double sd_kg() const;
  /// Its mass is known within a tenth, or known to be negligible.
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool holds() const;  // a load with a certain weight
  /// Uncertainty of the mass in addition to load(), kg.
  [[nodiscard]] double uncertainty_kg() const;

 private:
  static constexpr int kStates = 10;  // m, h, b_f, b_τ
  using Row = Eigen::Matrix<double, kStates, 1>;
  /// Filtered signals: f, τ, g - a, and α× + ω×ω× by columns.
  using Signals = Eigen::Matrix<double, 18, 1>;

  struct Smoothed {
    Signals signals, change;  // and its rate
    Vector3 gravity;
    double between_s;  // samples
  };
  void update(const Smoothed& at);
  /// Processes one equation: `row` . state = `value`, of variance `variance`.
  void take(const Row& row, double value, double variance);

  SensingConfig sensing_;
  double load_max_kg_;
  bool closed_ = false;
  bool begun_ = false;
  double since_s_ = 0.0, free_s_ = 0.0;
  int samples_ = 0;  // since the last update
  Signals first_ = Signals::Zero(), second_ = Signals::Zero();
  Row state_ = Row::Zero();
  Eigen::Matrix<double, kStates, kStates> covariance_ = Eigen::Matrix<double, kStates, kStates>::Zero();
};

}  // namespace longreach
