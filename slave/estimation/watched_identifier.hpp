#pragma once
// An identifier that, with any estimator, detects when the tool has moved to another object or layer. If the
// law of the estimator does not fit, its residual grows with the depth, so the residual is not evidence of a
// change. Therefore a maximum likelihood fit with a free exponent runs in parallel, and the estimate restarts
// when the force contradicts that fit.

#include "slave/estimation/identifier.hpp"

namespace longreach {

class WatchedIdentifier {
 public:
  explicit WatchedIdentifier(const IdentifierConfig& config)
      : judges_itself_(config.by_likelihood()), reported_(config), judge_(by_likelihood(config)) {}

  void begin() {
    reported_.begin();
    judge_.begin();
  }
  void step(const PenetrationSample& sample, double dt) {
    reported_.step(sample, dt);
    if (judges_itself_) return;
    const std::uint32_t before = judge_.changes();
    judge_.step(sample, dt);
    if (judge_.changes() != before) reported_.renew();
  }
  [[nodiscard]] ContactAnswer answer() { return reported_.answer(); }
  [[nodiscard]] const Identifier& reported() const { return reported_; }

 private:
  static IdentifierConfig by_likelihood(IdentifierConfig config) {
    config.kind = EstimatorKind::kMaximumLikelihood;
    config.make = nullptr;
    return config;
  }

  bool judges_itself_;
  Identifier reported_, judge_;
};

}  // namespace longreach
