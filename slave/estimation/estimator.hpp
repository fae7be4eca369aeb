#pragma once
// Interface for contact estimators that are not part of the slave: those of the laboratory, or your own.

#include <memory>
#include <utility>

#include "slave/estimation/contact_fit.hpp"

namespace longreach {

class Estimator {
 public:
  Estimator() = default;
  virtual ~Estimator() = default;
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;

  /// Starts a new contact and discards everything about the previous one.
  virtual void reset() = 0;
  /// Processes a sample in contact; `force_variance_n2` is the variance of its force, N². Returns the force
  /// minus the force predicted by the fit, N; NaN while there is no fit.
  virtual double step(const PenetrationSample& sample, double force_variance_n2) = 0;
  [[nodiscard]] virtual const ContactFit& fit() const = 0;
};

/// Wraps an external estimator in a value type, so that it can be used like those of this folder.
class BroughtEstimator {
 public:
  explicit BroughtEstimator(std::unique_ptr<Estimator> estimator) : it_(std::move(estimator)) {}

  void reset() { it_->reset(); }
  double step(const PenetrationSample& sample, double force_variance_n2) {
    return it_->step(sample, force_variance_n2);
  }
  [[nodiscard]] const ContactFit& fit() const { return it_->fit(); }

 private:
  std::unique_ptr<Estimator> it_;
};

}  // namespace longreach
