#pragma once
// The Hunt-Crossley law linearised by taking its logarithm (Haddadi and Hashtrudi-Zaad, IEEE T-RO 2012):
//   ln F = ln f + a v + n ln ξ,   for |a v| << 1
// The parameters are estimated by least squares with equal weights, as published. The bias of k is -4 % where
// a v reaches 0.42, and -20 % where it reaches 0.84. The noise of ln F grows as F decreases; samples with a
// force below 5 standard deviations are therefore skipped, which can exclude a large part of a touch.
// weighted_log_linear.hpp corrects both effects. The fit is updated when the number of samples has grown by
// 1/32, and at least every 32 samples.

#include <algorithm>

#include "slave/estimation/contact_fit.hpp"
#include "slave/estimation/normal_equations.hpp"

namespace longreach {

class LogLinear {
 public:
  explicit LogLinear(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = LogLinear(forgetting_); }

  /// Adds a sample, whose x_m must be > 0. Returns the force minus the predicted force, N, or NaN if there is
  /// no fit.
  double step(const PenetrationSample& sample, double force_variance_n2) {
    const double innovation = fit_.valid ? sample.force_n - fit_.force_at(sample) : std::nan("");
    if (!(sample.force_n > 0.0) || sample.force_n * sample.force_n < 25.0 * force_variance_n2)
      return innovation;
    if (samples_ == 0.0) fit_.reference_m = sample.x_m;
    const Eigen::Vector3d phi(1.0, std::log(sample.x_m / fit_.reference_m), sample.v_m_per_s);
    const double y = std::log(sample.force_n);
    equations_.add(phi, y, forgetting_);
    squares_ = forgetting_ * squares_ + y * y;
    samples_ = forgetting_ * samples_ + 1.0;
    if (++unused_ > std::min(kUnusedMax, samples_ / kShareUnused)) solve();
    return innovation;
  }
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  static constexpr double kShareUnused = 32.0, kUnusedMax = 31.0;

  void solve() {
    const Eigen::Matrix3d inverse = equations_.inverse();
    const Eigen::Vector3d theta = inverse * equations_.b();
    fit_.force_n = std::exp(theta[0]);
    fit_.n = theta[1];
    fit_.a_s_per_m = theta[2];
    const double residual = std::max(squares_ - theta.dot(equations_.b()), 1e-12 * squares_);
    fit_.covariance.topLeftCorner<3, 3>() = residual / std::max(samples_ - 3.0, 1.0) * inverse;
    fit_.valid = samples_ > 3.0 && std::isfinite(fit_.force_n) && fit_.covariance.allFinite();
    unused_ = 0.0;
  }

  double forgetting_;
  NormalEquations<3> equations_;
  double squares_ = 0.0;  // Σ w y²
  double samples_ = 0.0;  // Σ w
  double unused_ = 0.0;   // number of samples that are not yet in the fit
  ContactFit fit_{};
};

}  // namespace longreach
