#pragma once
// Tangent stiffness of a contact, identified without assuming a force law: a least squares fit of the force
// as a function of depth, and of depth times speed, about the mean depth x̄ of the last seconds, F = c + S (x
// - x̄) + b (x - x0) v. It is used where no power law fits, for example for a progressive foam, a pad on
// steel or a material with hysteresis. It is valid only in the range of depths that the tool covered.

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slave/estimation/identifier.hpp"

namespace longreach {

class LocalTangent {
 public:
  void begin() { *this = LocalTangent(); }

  /// Processes a sample. `surface_m`: estimated position of the surface, m. `memory_s` > 0: time constant of
  /// forgetting.
  void step(const PenetrationSample& s, double surface_m, double memory_s, double dt) {
    const double depth_m = s.x_m - surface_m;
    if (!std::isfinite(depth_m) || !std::isfinite(s.force_n) || !(depth_m > 0.0) || !(dt > 0.0)) return;
    if (samples_ == 0.0) origin_m_ = s.x_m;
    const double kept = std::exp(-dt / memory_s);
    const Eigen::Vector3d row(1.0, s.x_m - origin_m_, depth_m * s.v_m_per_s);
    A_ = kept * A_ + row * row.transpose();
    b_ = kept * b_ + s.force_n * row;
    squares_ = kept * squares_ + s.force_n * s.force_n;
    samples_ = kept * samples_ + 1.0;
  }

  /// Returns the tangent and the secant at the mean depth with their standard deviations. The result is not
  /// valid while the range of depths is too narrow.
  [[nodiscard]] ContactAnswer answer(double surface_m) const {
    ContactAnswer a;
    if (samples_ < kSamplesLeast) return a;
    const Eigen::Vector3d scale = A_.diagonal().cwiseSqrt();
    if (!(scale[1] > 0.0)) return a;
    // If the speed does not vary, the damping is not identifiable; a small ridge term then keeps it at zero.
    Eigen::Matrix3d R = A_;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (scale[i] > 0.0 && scale[j] > 0.0) R(i, j) /= scale[i] * scale[j];
      }
    }
    R.diagonal().array() += kRidge;
    const Eigen::Matrix3d inverse = R.inverse();
    const Eigen::Vector3d y = b_.cwiseQuotient(scale.cwiseMax(kSmallest));
    const Eigen::Vector3d fitted = inverse * y;
    const double variance = std::max(squares_ - fitted.dot(y), 0.0) / samples_;
    const double slope = fitted[1] / scale[1], mean_m = A_(0, 1) / A_(0, 0);
    a.depth_m = origin_m_ + mean_m - surface_m;
    const double force_n = fitted[0] / scale[0] + slope * mean_m;
    a.stiffness = {slope, std::sqrt(variance * std::max(inverse(1, 1), 0.0)) / scale[1]};
    a.secant = {force_n / a.depth_m, std::sqrt(variance / samples_) / a.depth_m};
    a.surface.value = surface_m;
    a.valid = std::isfinite(slope) && slope > 0.0 && a.depth_m > 0.0 && force_n > 0.0;
    return a;
  }

 private:
  static constexpr double kSamplesLeast = 500.0, kRidge = 1e-9, kSmallest = 1e-300;
  Eigen::Matrix3d A_ = Eigen::Matrix3d::Zero();  // sums over the rows (1, x, depth v)
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  double squares_ = 0.0, samples_ = 0.0, origin_m_ = 0.0;
};

}  // namespace longreach
