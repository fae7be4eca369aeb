#pragma once
// Hunt-Crossley with a given exponent, by recursive least squares of F = c0 ξⁿ + c1 ξⁿ v, as described in the
// source paper. Exact if the exponent is correct; with an error of 0.1, k is 33 % wrong for depths in
// millimetres, and the sd does not include that.

#include "slave/estimation/linear_contact.hpp"

namespace longreach {

class FixedExponent {
 public:
  FixedExponent(double exponent, double forgetting) : exponent_(exponent), forgetting_(forgetting) {}

  void reset() { *this = FixedExponent(exponent_, forgetting_); }
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (linear_.reference_m <= 0.0) linear_.reference_m = sample.x_m;
    const double power = std::pow(sample.x_m / linear_.reference_m, exponent_);
    return linear_.step({power, power * sample.v_m_per_s}, sample, forgetting_, force_variance_n2, exponent_,
                        false);
  }
  [[nodiscard]] const ContactFit& fit() const { return linear_.fit; }

 private:
  double exponent_;
  double forgetting_;
  LinearContact linear_;
};

}  // namespace longreach
