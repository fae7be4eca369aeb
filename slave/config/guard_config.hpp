#pragma once
// The lowest limit G of the force guard for which the force of a first touch stays below 1.35 G. At a speed v
// into a stiffness k, the tool advances by v T before it slows down, where T includes the lags of the loop and
// of the setpoint, and the time to detect the contact. Then the setpoint decelerates at a and reverses until
// the tool, which lags it by the time constant τ of the servo, has come to rest after the time t. If G is
// high, the setpoint starts to brake earlier, where the guard begins to limit the speed (contact_guard.hpp):
//   peak = max(k (v T + v t - a t²/2 + v τ),  G + k v lag - (k_max - k) v²/(2 a))
//   T = lag + touch/(k v) + √(2 τ_f touch/(k v)),   t = v/a + τ (1 - exp(-t/τ))
// This is an upper bound for a rigid tool; a tool of up to 10 kg with a servo bandwidth of at least 3 Hz also
// stays below it. The steady force after the touch is G itself.

#include <algorithm>
#include <cmath>

namespace longreach {

/// Upper bound on the force of a first touch, relative to the guard limit.
constexpr double kGuardOvershoot = 1.35;

struct FirstTouch {
  double stiffness_n_per_m = 5000.0;
  double guard_stiffness_n_per_m = 2e4;  // k_max >= k
  double speed_m_per_s = 0.05;
  double deceleration_m_per_s2 = 1.25;
  double lag_s = 0.0;     // delay from the force to the setpoint
  double servo_s = 0.0;   // τ, time constant from the setpoint to the tool
  double touch_n = 0.3;   // force above which a contact is detected
  double filter_s = 0.0;  // τ_f, time constant of the force filter of the detection
};

/// Returns the lowest guard limit for this touch, N.
inline double least_guard_n(const FirstTouch& t) {
  constexpr int kIterations = 50;
  const double k = t.stiffness_n_per_m, v = t.speed_m_per_s, a = t.deceleration_m_per_s2;
  const double notice_s = t.touch_n / (k * v);
  const double late_s = t.lag_s + notice_s + std::sqrt(2.0 * t.filter_s * notice_s);
  double rest_s = v / a + t.servo_s;
  for (int i = 0; i < kIterations && t.servo_s > 0.0; ++i) {
    rest_s =
        v / a - t.servo_s * std::expm1(-rest_s / t.servo_s);  // fixed-point iteration, converges from above
  }
  const double peak_n = k * (v * (late_s + rest_s + t.servo_s) - 0.5 * a * rest_s * rest_s);
  const double over_n = k * v * t.lag_s - (t.guard_stiffness_n_per_m - k) * 0.5 * v * v / a;
  return std::max(peak_n / kGuardOvershoot, over_n / (kGuardOvershoot - 1.0));
}

/// Returns the fastest first touch that a guard with the limit `guard_n` can stop, m/s, at most `fastest`.
inline double approach_speed(FirstTouch touch, double guard_n, double fastest) {
  constexpr int kHalvings = 30;
  const auto guarded = [&](double speed) {
    touch.speed_m_per_s = speed;
    return least_guard_n(touch) <= guard_n;
  };
  if (guarded(fastest)) return fastest;
  double below = 0.0, above = fastest;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (below + above);
    (guarded(middle) ? below : above) = middle;
  }
  return below;
}

}  // namespace longreach
