#pragma once
// Two least squares problems that feed each other (Diolaiti, Melchiorri, Stramigioli, IEEE T-RO 2005):
//   F = (c0 + c1 v) ξⁿ  for (c0, c1) with n as known;   ln(F/(c0 + c1 v)) = n ln ξ  for n with these
// ξ = x/x_ref with x_ref the largest depth within a factor of 2: with x in metres it does not converge at
// all. It takes 2 to 7 s, and its sd counts the noise only, not how far it still is. Samples below 5 sd of
// the force do not count for n.

#include <algorithm>

#include "slave/estimation/linear_contact.hpp"

namespace longreach {

class TwoStage {
 public:
  void reset() { *this = TwoStage(); }

  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (linear_.reference_m <= 0.0) linear_.reference_m = sample.x_m;
    if (sample.x_m > 2.0 * linear_.reference_m) refer_to(sample.x_m);
    const double log_xi = std::log(sample.x_m / linear_.reference_m);
    const double power = std::exp(n_ * log_xi);
    const double innovation =
        linear_.step({power, power * sample.v_m_per_s}, sample, kForgetting, force_variance_n2, n_, false);
    const double amplitude = linear_.fit.force_n * (1.0 + linear_.fit.a_s_per_m * sample.v_m_per_s);
    if (linear_.fit.valid && amplitude > 0.0 && sample.force_n > 5.0 * std::sqrt(force_variance_n2)) {
      equation_.add(Eigen::Matrix<double, 1, 1>(log_xi), std::log(sample.force_n / amplitude), kForgetting);
      const double n = equation_.inverse()(0, 0) * equation_.b()[0];
      if (std::isfinite(n)) n_ = std::clamp(n, 0.5, 3.5);
    }
    linear_.fit.covariance(1, 1) =
        equation_.inverse()(0, 0) * force_variance_n2 / (linear_.fit.force_n * linear_.fit.force_n);
    linear_.fit.valid = linear_.fit.valid && std::isfinite(linear_.fit.covariance(1, 1));
    return innovation;
  }
  [[nodiscard]] const ContactFit& fit() const { return linear_.fit; }

 private:
  static constexpr double kForgetting = 0.995;  // each stage has to forget what the other has told wrongly

  void refer_to(double depth_m) {
    const double unit = std::pow(depth_m / linear_.reference_m, n_);
    linear_.equations.rescale({unit, unit});
    linear_.reference_m = depth_m;
    linear_.fit.valid = false;
    equation_ = {};
  }

  LinearContact linear_;
  NormalEquations<1> equation_;
  double n_ = 1.0;
};

}  // namespace longreach
