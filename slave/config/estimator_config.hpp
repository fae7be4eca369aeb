#pragma once
// Parameters of the contact estimator. proto/config.proto documents the meaning, unit and range of these
// fields under the same names.

#include <cstdint>

namespace longreach {

enum class EstimatorKind : std::uint8_t { kFixedExponent = 0, kMaximumLikelihood = 4 };

struct EstimatorConfig {
  EstimatorKind kind = EstimatorKind::kMaximumLikelihood;
  double exponent = 1.0;
  double forgetting = 0.9999;  // per sample at 1 kHz
  double depth_memory_s = 2.0;
  /// Relative standard deviation at which a first value is reported. Its error is then up to 6 % (95th
  /// percentile); at 0.05 it would be 11 %, which is perceptible.
  double first_sd = 0.03;
  double deadband = 0.08;  // relative change
};

}  // namespace longreach
