#pragma once
// The estimator of log_linear.hpp with corrections for noise and damping. With û = v/(1 + â v), and the
// linearisation error p û², where p is the variance of a:
//   y = ln F - ln(1 + â v) + â û + σ²/(2 F̂²) = ln f + n ln ξ + a û,   weight F̂²/(σ² + (F̂ p û²)²)
// Published: the regression (Haddadi and Hashtrudi-Zaad, IEEE T-RO 2012), and the weight F², because noise σ
// in F becomes noise σ/F in ln F (Kiusalaas, Numerical Methods in Engineering, "Fitting exponential
// functions"). Added: (1) F̂ is the predicted force, because weights based on the measured force favour
// positive noise; until ln F̂ is known to within 10 %, F̂ is the measured force. (2) The term σ²/(2 F̂²)
// corrects the bias that noise causes in the mean of a logarithm. (3) ln(1 + a v) is linearised about the
// current â instead of 0, and the remainder is treated as noise, so that samples taken before a was known do
// not bias it. Samples with a force below 5 standard deviations are skipped. The fit is updated when the
// number of samples has grown by 1/32, and at least every 32 samples. Not handled: a v near -1, where the
// logarithm diverges.

#include <algorithm>

#include "deploy/lab/estimators/weak_prior.hpp"
#include "slave/estimation/contact_fit.hpp"
#include "slave/estimation/normal_equations.hpp"

namespace longreach {

class WeightedLogLinear {
 public:
  explicit WeightedLogLinear(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = WeightedLogLinear(forgetting_); }

  /// Adds a sample, whose x_m must be > 0. Returns the force minus the predicted force, N, or NaN if there is
  /// no fit.
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (samples_ == 0) fit_.reference_m = sample.x_m;
    const double log_xi = std::log(sample.x_m / fit_.reference_m), speed = sample.v_m_per_s;
    const double growth = 1.0 + fit_.a_s_per_m * speed;
    const double foreseen = fit_.valid ? fit_.force_n * std::exp(fit_.n * log_xi) * growth : std::nan("");
    const bool known = foreseen > 0.0 && well_known({1.0, log_xi, speed / growth});
    const double force = known ? foreseen : sample.force_n;
    if (sample.force_n > 0.0 && force * force >= kSd * kSd * force_variance_n2)
      add({sample.force_n, log_xi, speed}, force, force_variance_n2);
    if (unused_ > std::min(kUnusedMax, samples_ / kShareUnused)) solve(force_variance_n2);
    return sample.force_n - foreseen;
  }
  [[nodiscard]] const ContactFit& fit() const { return fit_; }
  [[nodiscard]] bool fresh() const { return unused_ == 0; }  // true if all samples are in the fit

 private:
  static constexpr double kSd = 5.0;
  static constexpr double kKnownSd = 0.1;    // maximum standard deviation of ln F̂
  static constexpr double kGrowthMin = 0.1;  // minimum of 1 + a v
  static constexpr int kShareUnused = 32, kUnusedMax = 31, kSamplesMin = 3, kSamplesMax = 1 << 20;

  struct Row {
    double force, log_xi, speed;
  };

  [[nodiscard]] bool well_known(const Eigen::Vector3d& h) const {
    return h.dot(fit_.covariance.topLeftCorner<3, 3>() * h) < kKnownSd * kKnownSd;
  }

  void add(const Row& row, double force, double variance) {
    const double growth = fit_.valid ? 1.0 + fit_.a_s_per_m * row.speed : 1.0;
    const bool about = growth > kGrowthMin;
    const double u = about ? row.speed / growth : row.speed;
    const double a_variance =
        fit_.valid ? fit_.covariance(2, 2) : weak_prior::kDampingSd * weak_prior::kDampingSd;
    const double left_n = force * a_variance * u * u;
    const double root = force / std::sqrt(1.0 + left_n * left_n / variance);
    const double y = (about ? std::log(row.force / growth) + 1.0 - 1.0 / growth : std::log(row.force)) +
                     0.5 * variance / (force * force);
    equations_.add(root * Eigen::Vector3d(1.0, row.log_xi, u), root * y, forgetting_);
    ++unused_;
    samples_ = std::min(samples_ + 1, kSamplesMax);
  }

  void solve(double variance) {
    const double sd = std::sqrt(variance), sd_of_n = sd / weak_prior::kExponentSd;
    NormalEquations<3> all = equations_;
    all.add({0.0, sd_of_n, 0.0}, sd_of_n * weak_prior::kExponent, 1.0);
    all.add({0.0, 0.0, sd / weak_prior::kDampingSd}, 0.0, 1.0);
    const Eigen::Matrix3d inverse = all.inverse();
    const Eigen::Vector3d theta = inverse * all.b();
    fit_.force_n = std::exp(theta[0]);
    fit_.n = theta[1];
    fit_.a_s_per_m = theta[2];
    fit_.covariance.topLeftCorner<3, 3>() = variance * inverse;
    fit_.valid = samples_ > kSamplesMin && theta.allFinite() && std::isfinite(fit_.force_n) &&
                 fit_.covariance.allFinite();
    unused_ = 0;
  }

  double forgetting_;
  NormalEquations<3> equations_;
  int samples_ = 0;
  int unused_ = 0;  // number of samples that are not yet in the fit
  ContactFit fit_{};
};

}  // namespace longreach
