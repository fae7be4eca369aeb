#pragma once
// Allows an estimator that requires a known surface to be used with an unknown one. ContactCurve estimates
// the position of the surface independently of the assumptions of the estimator. The estimator starts when
// the surface is known to within a fifth of the depth, and restarts when the estimated surface has moved by a
// twentieth of the depth. The reported standard deviations do not include the error of the surface position.

#include <limits>

#include "slave/estimation/contact_curve.hpp"

namespace longreach {

template <class Estimator>
class UnknownSurface {
 public:
  explicit UnknownSurface(const Estimator& estimator, double forgetting)
      : curve_({.forgetting = forgetting}), estimator_(estimator) {}

  void reset() {
    curve_.reset();
    begin(std::numeric_limits<double>::quiet_NaN());
    fit_ = {};
  }
  double step(const PenetrationSample& sample, double force_variance_n2) {
    curve_.step(sample, force_variance_n2);
    const ContactFit& place = curve_.fit();
    if (!place.valid) return std::numeric_limits<double>::quiet_NaN();
    const double depth = place.reference_m;
    const bool known = place.covariance(3, 3) < kKnown * kKnown * depth * depth;
    if (known && !(std::abs(place.surface_m - surface_m_) < kMoved * depth)) begin(place.surface_m);
    const double x = sample.x_m - surface_m_;
    const bool counts = std::isfinite(x) && x > kShallow * depth;
    if (!counts) return std::numeric_limits<double>::quiet_NaN();
    const double innovation = estimator_.step({x, sample.v_m_per_s, sample.force_n}, force_variance_n2);
    fit_ = estimator_.fit();
    fit_.surface_m = surface_m_;
    fit_.covariance(3, 3) = place.covariance(3, 3);
    return innovation;
  }
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  static constexpr double kKnown = 0.2, kMoved = 0.05;
  static constexpr double kShallow = 0.01;

  void begin(double surface_m) {
    estimator_.reset();
    surface_m_ = surface_m;
  }

  ContactCurve curve_;
  Estimator estimator_;
  double surface_m_ = std::numeric_limits<double>::quiet_NaN();  // NaN: not known yet
  ContactFit fit_{};
};

}  // namespace longreach
