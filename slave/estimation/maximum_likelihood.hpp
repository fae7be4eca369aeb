#pragma once
// Joint estimate of k, λ and n of a Hunt-Crossley contact: the maximum likelihood estimate from all samples
// for white Gaussian noise of the force, in bounded time per sample. For given n the law is linear in (f, f
// a); the sums of this least squares problem are stored for all n at once (exponent_sums.hpp), so n is found
// by Newton steps on the sums (variable projection, Golub and Pereyra 1973) and not by linearisation about an
// early, wrong estimate. (An extended Kalman filter is equally accurate where a v is small; where it is of
// the order of 1 it diverges, unless its linearisation error is treated as noise.) At first the sums are on a
// grid of n, whose best node starts the search; later they are a series about n. Weak priors, n 1.75 ± 1 and
// a 0 ± 10 s/m, keep the estimate bounded at constant speed or depth. The fit is updated when the number of
// samples has grown by 1/32, at least every 32. Not handled: an unknown surface; noise of the position, which
// biases every method.

#include "slave/estimation/exponent_sums.hpp"

namespace longreach {

class MaximumLikelihood {
 public:
  explicit MaximumLikelihood(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = MaximumLikelihood(forgetting_); }
  /// Returns the force minus the predicted force, N; NaN without a fit. `sample.x_m` > 0.
  double step(const PenetrationSample& sample, double force_variance_n2);
  /// Updates the fit with all samples.
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
  int unused_ = 0;  // of them, not yet in the fit
  ContactFit fit_{};
};

}  // namespace longreach
