#pragma once
// Parameters of the force/torque sensor and of contact detection. proto/config.proto defines meaning, unit
// and range under the same names. With touch_n = 0 the touch threshold is derived from the noise σ of the
// filtered force along an axis and from the drift d of the sensor:
//   touch = 8 σ + d √(10 s),   release = 0.4 touch
// Until σ has been measured (slave/sensing/touch_threshold.hpp), that of the configured noise is used, at
// least 0.3 N; the checks of the guards use it, too.

#include <algorithm>
#include <cmath>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct ToolLoadConfig {
  double mass_kg = 0.0;
  Vector3 com_m = Vector3::Zero();
  Vector3 inertia_kg_m2 = Vector3::Zero();
};

struct SensingConfig {
  double force_noise_n = 0.05;
  double moment_noise_nm = 0.005;
  double touch_n = 0.3;
  double release_n = 0.12;
  double filter_s = 0.01;
  double force_bias_n = 0.0, moment_bias_nm = 0.0;
  double force_drift_n = 0.0, moment_drift_nm = 0.0;
  double force_resolution_n = 0.0, moment_resolution_nm = 0.0;
  double force_range_n = 0.0, moment_range_nm = 0.0;
  double bandwidth_hz = 0.0;
  ToolLoadConfig tool{};
  Vector3 gravity_m_per_s2 = Vector3::Zero();
  double zero_s = 0.0;
  double touch_nm = 0.03;
  double release_nm = 0.012;
};

/// Drift of the force that the thresholds reckon with: standard deviation after a second, N.
inline double expected_drift_n(const SensingConfig& c) {
  constexpr double kUsualDrift_n = 0.05;  // of a sensor whose drift is not configured
  return std::max(c.force_drift_n, kUsualDrift_n);
}

/// By the standard deviation of the filtered force along an axis, N.
inline double derived_touch_n(const SensingConfig& c, double filtered_noise_n) {
  constexpr double kTouchSds = 8.0, kDriftTime_s = 10.0;
  return kTouchSds * filtered_noise_n + expected_drift_n(c) * std::sqrt(kDriftTime_s);
}

/// The touch threshold as configured; derived, that of the configured noise of samples at 1 kHz.
inline double configured_touch_n(const SensingConfig& c) {
  constexpr double kMinimum_n = 0.3, kPeriod_s = 1e-3;
  if (c.touch_n > 0.0) return c.touch_n;
  const double share = c.filter_s > 0.0 ? -std::expm1(-kPeriod_s / c.filter_s) : 1.0;
  const double noise_n = std::hypot(c.force_noise_n, c.force_resolution_n / std::sqrt(12.0));
  return std::max(kMinimum_n, derived_touch_n(c, noise_n * std::sqrt(share / (2.0 - share))));
}

inline double release_of_n(const SensingConfig& c, double touch_n) {
  constexpr double kReleaseShare = 0.4;
  return c.touch_n > 0.0 ? c.release_n : kReleaseShare * touch_n;
}

/// With both thresholds, before anything has been measured.
inline SensingConfig with_thresholds(SensingConfig c) {
  const double touch_n = configured_touch_n(c);
  c.release_n = release_of_n(c, touch_n);
  c.touch_n = touch_n;
  return c;
}

}  // namespace longreach
