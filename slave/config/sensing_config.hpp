#pragma once
// Thresholds of contact detection. If touch_n is 0, the touch threshold is derived from
// the noise σ of the filtered force along an axis and from the drift d of the sensor:
//   touch = 8 σ + d √(10 s),   release = 0.4 touch
// Until σ has been measured (slave/sensing/touch_threshold.hpp), the configured noise determines σ, and the
// threshold is at least 0.3 N. The configuration checks of the guards use this threshold, too.

#include <algorithm>
#include <cmath>

#include "common/core/low_pass.hpp"
#include "schema/config_slave.hpp"

namespace longreach {

/// Returns whether the robot measures moments. A robot without a force sensor does not.
inline bool measures_moment(const SensingConfig& c) { return c.force && c.moment; }

/// Returns the drift of the force that the thresholds allow for: its standard deviation after one second, N.
inline double expected_drift_n(const SensingConfig& c) {
  constexpr double kUsualDrift_n = 0.05;  // used if no drift is configured
  return std::max(c.force_drift_n, kUsualDrift_n);
}

/// Returns the touch threshold for this standard deviation of the filtered force along an axis, N.
inline double derived_touch_n(const SensingConfig& c, double filtered_noise_n) {
  constexpr double kTouchSds = 8.0, kDriftTime_s = 10.0;
  return kTouchSds * filtered_noise_n + expected_drift_n(c) * std::sqrt(kDriftTime_s);
}

/// Returns the configured touch threshold or, if it is to be derived, the threshold for the configured noise
/// at 1 kHz, N.
inline double configured_touch_n(const SensingConfig& c) {
  constexpr double kMinimum_n = 0.3, kPeriod_s = 1e-3;
  if (c.touch_n > 0.0) return c.touch_n;
  const double share = low_pass_share(kPeriod_s, c.filter_s);
  const double noise_n = std::hypot(c.force_noise_n, c.force_resolution_n / std::sqrt(12.0));
  return std::max(kMinimum_n, derived_touch_n(c, noise_n * std::sqrt(share / (2.0 - share))));
}

/// Returns the release threshold that corresponds to `touch_n`, N.
inline double release_of_n(const SensingConfig& c, double touch_n) {
  constexpr double kReleaseShare = 0.4;
  return c.touch_n > 0.0 ? c.release_n : kReleaseShare * touch_n;
}

/// Returns the configuration with both thresholds set to the values before any measurement.
inline SensingConfig with_thresholds(SensingConfig c) {
  const double touch_n = configured_touch_n(c);
  c.release_n = release_of_n(c, touch_n);
  c.touch_n = touch_n;
  return c;
}

}  // namespace longreach
