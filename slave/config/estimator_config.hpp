#pragma once
// Parameters of the contact estimator. Meaning, unit and range: proto/config.proto; the same names.

#include <cstdint>

namespace longreach {

enum class EstimatorKind : std::uint8_t { kFixedExponent = 0, kMaximumLikelihood = 4 };

struct EstimatorConfig {
  EstimatorKind kind = EstimatorKind::kMaximumLikelihood;
  double exponent = 1.0;
  double forgetting = 0.9999;  // a sample at 1 kHz
  double depth_memory_s = 2.0;
  double first_sd = 0.03;  // fraction; first values off by up to 6 % (p95); 0.05: 11 %, which is felt
  double deadband = 0.08;  // fraction
};

}  // namespace longreach
