#pragma once
// Parameters of the contact estimator. proto/config.proto defines meaning, unit and range under the same
// names.

#include <cstdint>

namespace longreach {

enum class EstimatorKind : std::uint8_t { kFixedExponent = 0, kMaximumLikelihood = 4 };

struct EstimatorConfig {
  EstimatorKind kind = EstimatorKind::kMaximumLikelihood;
  double exponent = 1.0;
  double forgetting = 0.9999;  // per sample at 1 kHz
  double depth_memory_s = 2.0;
  /// fraction; the error of first values is up to 6 % (p95); at 0.05: 11 %, which is perceptible
  double first_sd = 0.03;
  double deadband = 0.08;  // fraction
};

}  // namespace longreach
