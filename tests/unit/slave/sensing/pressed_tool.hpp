#pragma once
// Generates the inputs of the force checks tick by tick: a tool moves as commanded against a wall of known
// stiffness, and its force sensor may be rotated. The force of the wall is F = k d n, where d is the depth of
// the tool.

#include <algorithm>
#include <cmath>

#include "common/core/random.hpp"
#include "slave/sensing/growth_watch.hpp"

namespace longreach::test {

struct PressedTool {
  static constexpr double kDt = 1e-3;

  double wall_n_per_m = 1e3;
  Vector3 normal = -Vector3::UnitX();  // outward normal of the wall
  double wall_m = 0.0;                 // position of the surface along -normal, from the origin
  Matrix3 sensor = Matrix3::Identity();
  double noise_n = 0.0;
  double bandwidth_hz = 0.0;
  Vector3 p_m = Vector3::Zero();
  Vector3 reported_n = Vector3::Zero();
  Random random{1};
  GrowthWatch watch{GrowthBounds{}};
  bool suspected = false;  // true if the check suspected the sensor at any time

  explicit PressedTool(double stiffness_n_per_m) : wall_n_per_m(stiffness_n_per_m) {}

  /// Limits the bandwidth of the sensor and configures the check accordingly.
  void slow_sensor(double hz) {
    bandwidth_hz = hz;
    watch.configure({.bandwidth_hz = hz});
  }
  [[nodiscard]] double force_n() const { return wall_n_per_m * std::max(0.0, -normal.dot(p_m) - wall_m); }

  /// Runs one tick with the tool at this velocity.
  void go(const Vector3& m_per_s) {
    p_m += kDt * m_per_s;
    const Vector3 true_n = sensor * (force_n() * normal);
    const double share = bandwidth_hz > 0.0 ? -std::expm1(-6.283185307179586 * bandwidth_hz * kDt) : 1.0;
    reported_n += share * (true_n - reported_n);
    const Vector3 noise(random.normal(), random.normal(), random.normal());
    report(reported_n + noise_n * noise);
  }
  /// Runs one tick in which the sensor reports this force, independently of the wall.
  void report(const Vector3& force_n) {
    watch.step({p_m, force_n, force_n.norm() > 0.1, kDt});
    suspected = suspected || !watch.direction().isZero(0.0);
  }
  void go(const Vector3& m_per_s, double seconds) {
    for (int i = 0; i < std::lround(seconds / kDt); ++i) go(m_per_s);
  }
};

inline Matrix3 turned(double rad, const Vector3& axis) {
  return Eigen::AngleAxisd(rad, axis).toRotationMatrix();
}

}  // namespace longreach::test
