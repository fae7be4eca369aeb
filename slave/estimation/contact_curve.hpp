#pragma once
// Identifies the surface together with k, λ and n of the material behind it:
//   F = f (ξⁿ + a v ξᵐ),  ξ = (x - x0)/x_ref for x > x0, else 0;   m = n, Kelvin-Voigt: m = 0
// For white Gaussian noise of the force this is the maximum likelihood estimate from all samples: for given n
// and x0 the law is linear in (f, f a), so these are projected out (Golub and Pereyra 1973), and n and x0 are
// found by damped Gauss-Newton steps on the bins of the samples (depth_bins.hpp). Samples before the touch
// are included: their zero force excludes positions of the surface. n is free, or given. Weak priors: n 1.5 ±
// 0.5, a 0 ± 2.5 s/m (known materials have less than 1). At constant speed a and k are not distinguishable
// otherwise: compared with ± 10 s/m, a free n is known in 0.8 instead of 1.3 s in 9 of 10 touches, and first
// values are wrong by at most 7 % instead of 46 %; with ± 3 s/m one of 3600 touches displayed a wall 5.8 %
// wrong; for a material of 10 s/m the error then exceeds its sd. The fit is updated when the number of
// samples has grown by 1/32, at least every 128. Not handled: noise of the position.

#include "slave/estimation/depth_bins.hpp"

namespace longreach {

class ContactCurve {
 public:
  struct Law {
    double exponent = 0.0;  // 0: free
    double forgetting = 1.0;
    bool kelvin_voigt = false;
  };
  explicit ContactCurve(const Law& law);

  void reset() { *this = ContactCurve(law_); }
  /// Returns the force minus the predicted force, N; NaN without a fit.
  double step(const PenetrationSample& sample, double force_variance_n2);
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  struct Place {
    double n = 1.0;
    double x0 = 0.0;
  };
  struct Fitted;

  [[nodiscard]] Fitted fitted(const Place& place, double variance) const;
  void refresh(double force_variance_n2);
  void search(double variance);
  void publish(const Fitted& fitted, double variance);

  Law law_;
  double prior_n_, prior_n_sd_;
  int memory_;  // samples, as far as relevant for the update rate of the fit
  DepthBins bins_;
  double shallowest_m_ = 0.0, deepest_m_ = 0.0;
  bool sought_ = false;  // a first position was found
  Place place_;
  double damping_ = 1e-3;
  int samples_ = 0;
  int unused_ = 0;  // of them, not yet in the fit
  ContactFit fit_{};
};

}  // namespace longreach
