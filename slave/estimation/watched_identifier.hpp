#pragma once
// An identifier that, with any estimator, detects when the tool has moved to another object or layer. If the
// law of the estimator does not fit, its residual grows with the depth, so the residual is not evidence of a
// change. Therefore a maximum likelihood fit with a free exponent runs in parallel, and the estimate restarts
// when the force contradicts that fit.

#include "slave/estimation/identifier.hpp"

namespace longreach {

class WatchedIdentifier {
 public:
  explicit WatchedIdentifier(const IdentifierConfig& config, std::unique_ptr<Estimator> brought = nullptr)
      : reported_(config, std::move(brought)), judge_(by_likelihood(config)) {}

  void begin() {
    reported_.begin();
    judge_.begin();
  }
  void step(const PenetrationSample& sample, double dt) {
    reported_.step(sample, dt);
    if (reported_.by_likelihood()) return;
    const std::uint32_t before = judge_.changes();
    judge_.step(sample, dt);
    if (judge_.changes() != before) reported_.renew();
  }
  [[nodiscard]] ContactAnswer answer() { return reported_.answer(); }
  [[nodiscard]] const Identifier& reported() const { return reported_; }

 private:
  static IdentifierConfig by_likelihood(IdentifierConfig config) {
    config.kind = EstimatorKind::kMaximumLikelihood;
    return config;
  }

  Identifier reported_, judge_;
};

}  // namespace longreach
