#pragma once
// Parameters of the contact estimator. Meaning, unit and range: proto/config.proto; the same names.

namespace longreach {

struct EstimatorConfig {
  double exponent = 1.0;
  double forgetting = 0.9998;  // a sample at 1 kHz
  double depth_filter_s = 10.0;
  double first_sd = 0.05;        // fraction
  double deadband = 0.08;        // fraction
  double working_force_n = 3.0;  // at the hand
};

}  // namespace longreach
