#pragma once
// Hunt-Crossley law with a given exponent, identified by recursive least squares of F = c0 ξⁿ + c1 ξⁿ v. The
// estimate is exact if the exponent is correct. If the exponent is wrong by 0.1, k is wrong by 33 % for
// depths of millimetres, and the standard deviation does not include this error.

#include "slave/estimation/linear_contact.hpp"

namespace longreach {

class FixedExponent {
 public:
  FixedExponent(double exponent, double forgetting) : exponent_(exponent), forgetting_(forgetting) {}

  void reset() { *this = FixedExponent(exponent_, forgetting_); }
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (linear_.reference_m <= 0.0) linear_.reference_m = sample.x_m;
    const double power = std::pow(sample.x_m / linear_.reference_m, exponent_);
    return linear_.step({power, power * sample.v_m_per_s}, sample, forgetting_, force_variance_n2, exponent_);
  }
  [[nodiscard]] const ContactFit& fit() const { return linear_.fit; }

 private:
  double exponent_;
  double forgetting_;
  LinearContact linear_;
};

}  // namespace longreach
