#pragma once
// Joint estimate of k, λ and n of a Hunt-Crossley contact: the maximum likelihood estimate from all samples
// under white Gaussian force noise, computed in bounded time per sample. For given n the law is linear in f
// and f a. The sums of this least squares problem are stored for all n at once (exponent_sums.hpp), so Newton
// steps on the sums find n (variable projection, Golub and Pereyra 1973), without linearization about an
// early, wrong estimate. (An extended Kalman filter is equally accurate where a v is small. Where a v is of
// the order of 1, it diverges unless its linearization error is treated as noise.) At first the sums are
// stored on a grid of n, and the search starts at the best node; later they are stored as a series about n.
// Weak priors, n = 1.75 ± 1 and a = 0 ± 10 s/m, keep the estimate bounded at constant speed or depth. The fit
// is updated whenever the number of samples has grown by 1/32, and at least every 32 samples. The position of
// the surface must be known. Position noise, which would bias every method, is not modelled.

#include "slave/estimation/exponent_sums.hpp"

namespace longreach {

class MaximumLikelihood {
 public:
  explicit MaximumLikelihood(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = MaximumLikelihood(forgetting_); }
  /// Processes a sample with `sample.x_m` > 0. Returns the force minus the predicted force, N; NaN while
  /// there is no fit.
  double step(const PenetrationSample& sample, double force_variance_n2);
  /// Updates the fit so that it includes all samples.
  void refresh(double force_variance_n2);
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  void search(double variance);

  double forgetting_;
  SampleScale scale_;
  ExponentGrid grid_;
  ExponentSeries series_;
  bool known_ = false;  // n is known accurately enough for the series
  double n_ = 1.75;
  int samples_ = 0;
  int unused_ = 0;  // samples not yet included in the fit
  ContactFit fit_{};
};

}  // namespace longreach
