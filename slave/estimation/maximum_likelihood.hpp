#pragma once
// k, λ and n of a Hunt-Crossley contact together: for white, normally distributed noise of the force the
// maximum of the likelihood of all samples, in bounded time a sample. Given n the law is linear in (f, f a);
// the sums of that least squares problem are kept for all n at once (exponent_sums.hpp), so n is found by
// Newton's steps on the sums (variable projection, Golub and Pereyra 1973) and not by linearising about an
// early, wrong estimate. (An extended Kalman filter does as well where a v is small; where it is of the order
// of 1 it diverges, unless its linearisation error counts as noise.) While little is known the sums stand on
// a grid of n, whose best node starts the search; then in a series about n. Weak priors, n 1.75 ± 1 and a 0 ±
// 10 s/m, so that nothing is unbounded at constant speed or depth. The fit is brought up to date when the
// samples have grown by 1/32, at least every 32. Not handled: an unknown surface; noise of the position,
// which biases every method.

#include "slave/estimation/exponent_sums.hpp"

namespace longreach {

class MaximumLikelihood {
 public:
  explicit MaximumLikelihood(double forgetting) : forgetting_(forgetting) {}

  void reset() { *this = MaximumLikelihood(forgetting_); }
  /// Returns the force less what was foreseen, N; NaN without a fit. `sample.x_m` > 0.
  double step(const PenetrationSample& sample, double force_variance_n2);
  /// Brings the fit up to the last sample.
  void refresh(double force_variance_n2);
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  void search(double variance);

  double forgetting_;
  SampleScale scale_;
  ExponentGrid grid_;
  ExponentSeries series_;
  bool known_ = false;  // n, so well that the series holds the sums
  double n_ = 1.75;
  int samples_ = 0;
  int unused_ = 0;  // of them, not yet in the fit
  ContactFit fit_{};
};

}  // namespace longreach
