#pragma once
// Identifies the position of a surface together with k, λ and n of the material behind it:
//   F = f ξⁿ (1 + a v),  ξ = (x - x0)/x_ref for x > x0, else 0
// Under white Gaussian force noise this is the maximum likelihood estimate from all samples. For given n and
// x0 the law is linear in f and f a, so these two parameters are projected out (Golub and Pereyra 1973), and
// damped Gauss-Newton steps on the binned samples (depth_bins.hpp) find n and x0. Samples before the touch
// are included, because their zero force excludes some positions of the surface. n is either free or given.
//
// At constant speed, a and k are not distinguishable without a prior. The priors are weak: n = 1.5 ± 0.5 and
// a = 0 ± 2.5 s/m (known materials have less than 1 s/m). With a = 0 ± 10 s/m instead, identifying a free n
// takes 1.3 s instead of 0.8 s in 9 of 10 touches, and first values are wrong by up to 46 % instead of 7 %.
// With a = 0 ± 3 s/m, the displayed wall had an error of 5.8 % in one of 3600 touches. If a material has a =
// 10 s/m, the error exceeds the reported standard deviation.
//
// The fit is updated whenever the number of samples has grown by 1/32, and at least every 128 samples.
// Position noise is not modelled.

#include "slave/estimation/depth_bins.hpp"

namespace longreach {

class ContactCurve {
 public:
  struct Law {
    double exponent = 0.0;  // 0: free
    double forgetting = 1.0;
  };
  explicit ContactCurve(const Law& law);

  void reset() { *this = ContactCurve(law_); }
  /// Processes a sample. Returns the force minus the predicted force, N; NaN while there is no fit.
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
  int memory_;  // memory of the forgetting factor, in samples; sets the update rate of the fit
  DepthBins bins_;
  double shallowest_m_ = 0.0, deepest_m_ = 0.0;
  bool sought_ = false;  // an initial position of the surface was found
  Place place_;
  double damping_ = 1e-3;
  int samples_ = 0;
  int unused_ = 0;  // samples not yet included in the fit
  ContactFit fit_{};
};

}  // namespace longreach
