#pragma once
// An identifier that detects another object or layer under the tool with any estimator. If the law of an
// estimator does not fit, its error grows with the depth, which indicates nothing. A maximum likelihood fit,
// which assumes no particular law, therefore runs in parallel: when the force contradicts it, the estimate
// restarts as well.

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
