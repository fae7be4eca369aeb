#pragma once
// Estimates the Hunt-Crossley parameters by two coupled least squares problems (Diolaiti, Melchiorri,
// Stramigioli, IEEE T-RO 2005):
//   F = (c0 + c1 v) ξⁿ  for (c0, c1) with the present n;   ln(F/(c0 + c1 v)) = n ln ξ  for n with these
// Published: the two problems, solved recursively. Added, because each is necessary for good accuracy: (1) ξ
// = x/x_ref, because with x in metres the estimates do not converge. x_ref is the weighted geometric mean of
// the depths, so that an error in n hardly changes c0 and both stages converge quickly. (2) The weight in the
// second problem, and the bias correction for the logarithm (weighted_log_linear.hpp). (3) The prior. (4)
// Additional forgetting at the start, by the factor 1 - 0.05·0.995^samples, so that both stages forget their
// initial errors (Ljung and Söderström, Theory and Practice of Recursive Identification). The reported
// standard deviations include only the noise, not errors due to incomplete convergence. Samples with a force
// below 5 standard deviations are not used for n. Not handled: a v of the order of 1, where the estimates do
// not converge within 2 s.

#include <algorithm>

#include "deploy/lab/estimators/weak_prior.hpp"
#include "slave/estimation/contact_fit.hpp"
#include "slave/estimation/normal_equations.hpp"

namespace longreach {

class TwoStage {
 public:
  explicit TwoStage(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = TwoStage(forgetting_); }

  /// Adds a sample, whose x_m must be > 0. Returns the force minus the predicted force, N, or NaN if there is
  /// no fit.
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (startup_ == kStartup) fit_.reference_m = sample.x_m;
    startup_ *= kStartupKept;
    const double memory = forgetting_ * (1.0 - startup_);
    const double log_xi = std::log(sample.x_m / fit_.reference_m), power = std::exp(fit_.n * log_xi);
    const double speed = sample.v_m_per_s;
    const double innovation =
        fit_.valid ? sample.force_n - fit_.force_n * power * (1.0 + fit_.a_s_per_m * speed) : std::nan("");

    const double first_guess = fit_.valid ? fit_.force_n : sample.force_n / power;
    linear_.add({power, power * speed}, sample.force_n, memory);
    solve_linear(first_guess, force_variance_n2);

    const double amplitude = fit_.force_n * (1.0 + fit_.a_s_per_m * speed), force = amplitude * power;
    const double weight = force * force;
    if (fit_.valid && amplitude > 0.0 && sample.force_n > 0.0 && weight < kWeightMax &&
        weight > kSd * kSd * force_variance_n2) {
      const double log_ratio = std::log(sample.force_n / amplitude) + 0.5 * force_variance_n2 / weight;
      exponent_.add(weight, log_xi, log_ratio, memory);
      solve_exponent(force_variance_n2);
    }
    return innovation;
  }
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  static constexpr double kStartup = 0.05, kStartupKept = 0.995;
  static constexpr double kSd = 5.0, kWeightMax = 1e30;  // N²
  static constexpr double kExponentMin = 0.5, kExponentMax = 3.5;
  /// Maximum weighted mean of ln ξ, in magnitude, before x_ref is changed.
  static constexpr double kOffMean = 0.05;

  /// Weighted sums of the second stage, with the weight w, l = ln ξ and y = ln(F/(c0 + c1 v)).
  struct ExponentSums {
    double w = 0.0, l = 0.0, ll = 0.0, y = 0.0, ly = 0.0;

    void add(double weight, double log_xi, double log_ratio, double memory) {
      w = memory * w + weight;
      l = memory * l + weight * log_xi;
      ll = memory * ll + weight * log_xi * log_xi;
      y = memory * y + weight * log_ratio;
      ly = memory * ly + weight * log_xi * log_ratio;
    }
    /// Multiplies the reference depth by exp(by): l' = l - by, y' = y - n by.
    void refer(double by, double n) {
      const double y_after = y - n * by * w;
      ly += -n * by * l - by * y_after;
      ll += by * (by * w - 2.0 * l);
      l -= by * w;
      y = y_after;
    }
  };

  void solve_linear(double first_guess, double variance) {
    NormalEquations<2> all = linear_;
    all.add({0.0, std::sqrt(variance) / (weak_prior::kDampingSd * first_guess)}, 0.0, 1.0);
    const Eigen::Matrix2d inverse = all.inverse();
    const Eigen::Vector2d c = inverse * all.b();
    fit_.force_n = c[0];
    fit_.a_s_per_m = c[1] / c[0];
    Eigen::Matrix2d J;  // Jacobian of (ln f, a) with respect to c
    J << 1.0 / c[0], 0.0, -fit_.a_s_per_m / c[0], 1.0 / c[0];
    const Eigen::Matrix2d of = variance * J * inverse * J.transpose();
    fit_.covariance(0, 0) = of(0, 0);
    fit_.covariance(0, 2) = fit_.covariance(2, 0) = of(0, 1);
    fit_.covariance(2, 2) = of(1, 1);
    fit_.valid = c[0] > 0.0 && std::isfinite(fit_.a_s_per_m) && fit_.covariance.allFinite();
  }

  void solve_exponent(double variance) {
    const double prior = variance / (weak_prior::kExponentSd * weak_prior::kExponentSd);
    const double n = (exponent_.ly + prior * weak_prior::kExponent) / (exponent_.ll + prior);
    if (!std::isfinite(n)) return;
    fit_.n = std::clamp(n, kExponentMin, kExponentMax);
    fit_.covariance(1, 1) = variance / (exponent_.ll + prior);
    const double by = exponent_.l / exponent_.w;
    if (std::abs(by) < kOffMean) return;
    const double unit = std::exp(fit_.n * by);
    linear_.rescale({unit, unit});
    exponent_.refer(by, fit_.n);
    fit_.force_n *= unit;
    fit_.reference_m *= std::exp(by);
  }

  double forgetting_;
  double startup_ = kStartup;
  NormalEquations<2> linear_;
  ExponentSums exponent_;
  ContactFit fit_{};
};

}  // namespace longreach
