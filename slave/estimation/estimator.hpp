#pragma once
// An estimator of a contact that is not the slave's own: of the laboratory, or yours.

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

  /// Another contact: nothing of the one before is kept.
  virtual void reset() = 0;
  /// A sample in contact and the variance of its force, N². Returns by how much the force was off what the
  /// fit had foreseen, N; NaN where there is none yet.
  virtual double step(const PenetrationSample& sample, double force_variance_n2) = 0;
  [[nodiscard]] virtual const ContactFit& fit() const = 0;
};

/// Held as those of this folder are.
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
