#pragma once
// Linear spring-damper model F = K x + B v, fitted by recursive least squares: k = K in N/m, λ = B in N s/m,
// n = 1. The model is wrong at touch and release, where the force jumps by B v and may pull, and for
// materials with an exponent n other than 1.

#include "slave/estimation/linear_contact.hpp"

namespace longreach {

class KelvinVoigt {
 public:
  explicit KelvinVoigt(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = KelvinVoigt(forgetting_); }
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (linear_.reference_m <= 0.0) linear_.reference_m = sample.x_m;
    linear_.fit.kelvin_voigt = true;
    return linear_.step({sample.x_m / linear_.reference_m, sample.v_m_per_s}, sample, forgetting_,
                        force_variance_n2, 1.0);
  }
  [[nodiscard]] const ContactFit& fit() const { return linear_.fit; }

 private:
  double forgetting_;
  LinearContact linear_;
};

}  // namespace longreach
