#include "common/config/guarded.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/text/number_text.hpp"
#include "slave/config/guard_config.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {
namespace {

double first_order_s(double bandwidth_hz) {
  return bandwidth_hz > 0.0 ? 0.5 / (std::numbers::pi * bandwidth_hz) : 0.0;
}

FirstTouch first_touch(const proto::SlaveConfig& config) {
  FirstTouch touch;
  touch.stiffness_n_per_m = std::min(touch.stiffness_n_per_m, config.command().guard_stiffness_n_per_m());
  touch.guard_stiffness_n_per_m = config.command().guard_stiffness_n_per_m();
  touch.speed_m_per_s = std::min(touch.speed_m_per_s, config.command().speed_max_m_per_s());
  touch.deceleration_m_per_s2 = config.command().acceleration_max_m_per_s2();
  double jerk_s = 0.0;  // that the setpoint is late by, for its jerk limit
  for (const proto::Joint& j : config.robot().joint()) {
    jerk_s = std::max(jerk_s, j.acceleration_max_rad_per_s2() / j.jerk_max_rad_per_s3());
  }
  touch.lag_s = 1.0 / config.loop().rate_hz() + jerk_s + first_order_s(config.sensing().bandwidth_hz());
  touch.servo_s = first_order_s(config.robot().servo_hz());
  touch.touch_n = guarded_touch_n(config.sensing());
  touch.filter_s = config.sensing().filter_s();
  return touch;
}

/// What holds the guard instead, within what is allowed.
std::string advice(const proto::SlaveConfig& config, FirstTouch touch, double least_n) {
  const double guard_n = config.command().force_guard_n(), range_n = config.sensing().force_range_n();
  constexpr double kGuardMaxN = 1000.0, kSpeedMin = 1e-4;  // of the fields
  const double rounded_n = std::ceil(10.0 * least_n) / 10.0;
  const bool allowed = rounded_n <= kGuardMaxN && (range_n <= 0.0 || rounded_n < range_n);
  double below = 0.0, above = touch.speed_m_per_s;
  for (int i = 0; i < 50; ++i) {
    touch.speed_m_per_s = 0.5 * (below + above);
    (least_guard_n(touch) <= guard_n ? below : above) = touch.speed_m_per_s;
  }
  below = std::floor(1e4 * below) / 1e4;
  const std::string slower = below >= kSpeedMin ? "lower command.speed_max_m_per_s to " + format_number(below)
                                                : std::string("lower command.guard_stiffness_n_per_m");
  if (allowed) return "; set it to that value, or " + slower;
  return ", which " +
         (rounded_n > kGuardMaxN ? "is above " + format_number(kGuardMaxN)
                                 : "sensing.force_range_n = " + format_number(range_n) + " does not allow") +
         "; " + slower;
}

constexpr double kOvershootShare = kGuardOvershoot - 1.0;

/// What a sensor may hide of a force or moment, by channel: the bias, and the resolution and drift of 10 s.
struct Hidden {
  double bias = 0.0, rest = 0.0;

  Hidden(double bias_of_channel, double resolution, double drift)
      : bias(std::sqrt(3.0) * std::abs(bias_of_channel)),
        rest(std::sqrt(3.0) * 0.5 * resolution + 2.0 * drift * std::sqrt(10.0)) {}
  /// Returns the lowest guard limit. `zeroed` is the share of the limit up to which a bias is zeroed; 0: never.
  [[nodiscard]] double least_guard(double zeroed) const {
    if (zeroed <= 0.0) return (bias + rest) / kOvershootShare;
    return std::max(rest / kOvershootShare, bias / zeroed);
  }
};

/// Share of the force guard up to which a bias of the force is zeroed, during free motion or at the start
/// (bias_tracker.hpp, tool_load.hpp).
double zeroed_share(const proto::Sensing& sensing) {
  constexpr double kTracked = 0.6, kAtStart = 0.5;
  if (sensing.touch_n() <= 0.0) return kTracked;
  return sensing.zero_s() > 0.0 ? kAtStart : 0.0;
}

double rounded_up(double value) { return std::ceil(10.0 * value) / 10.0; }

std::string hides(double guard, double least, const char* quantity, const char* unit) {
  const std::string suffix(unit);
  return " = " + format_number(guard) + " cannot be enforced with the sensor, whose sensing." + quantity +
         "_bias_" + suffix + ", _drift_" + suffix + " or _resolution_" + suffix + " may hide a part of the " +
         quantity + "; the minimum is " + format_number(rounded_up(least)) +
         "; set it to that value, or lower these figures";
}

std::string not_above(double range, const std::string& guard, double value) {
  if (range <= 0.0 || value < range) return "";
  return " = " + format_number(range) + " is not above command." + guard + " = " + format_number(value);
}

}  // namespace

double guarded_touch_n(const proto::Sensing& sensing) {
  SensingConfig c;
  c.touch_n = sensing.touch_n();
  c.filter_s = sensing.filter_s();
  c.force_noise_n = sensing.force_noise_n();
  c.force_resolution_n = sensing.force_resolution_n();
  c.force_drift_n = sensing.force_drift_n();
  return configured_touch_n(c);
}

std::string touch_text(const proto::Sensing& sensing) {
  const std::string value = format_number(guarded_touch_n(sensing));
  return (sensing.touch_n() > 0.0 ? "sensing.touch_n = " : "the derived touch threshold, ") + value;
}

std::string unguarded(const proto::SlaveConfig& config) {
  if (!config.sensing().force()) return "";
  const FirstTouch touch = first_touch(config);
  const double guard_n = config.command().force_guard_n(), least_n = least_guard_n(touch);
  const proto::Sensing& s = config.sensing();
  const double hidden_n =
      Hidden(s.force_bias_n(), s.force_resolution_n(), s.force_drift_n()).least_guard(zeroed_share(s));
  if (guard_n < hidden_n && hidden_n > least_n) return hides(guard_n, hidden_n, "force", "n");
  if (guard_n >= least_n) return "";
  return " = " + format_number(guard_n) +
         " cannot be enforced when the tool touches a surface with a stiffness of " +
         format_number(touch.stiffness_n_per_m) + " N/m at " + format_number(touch.speed_m_per_s) +
         " m/s; the minimum is " + format_number(std::ceil(10.0 * least_n) / 10.0) +
         advice(config, touch, least_n);
}

std::string unguarded_moment(const proto::SlaveConfig& config) {
  const proto::Sensing& s = config.sensing();
  if (!s.force() || !s.moment()) return "";
  const double guard_nm = config.command().moment_guard_nm();
  // The bias of the moment is zeroed without a bound.
  const double bias_nm = s.zero_s() > 0.0 ? 0.0 : s.moment_bias_nm();
  const double hidden_nm = Hidden(bias_nm, s.moment_resolution_nm(), s.moment_drift_nm()).least_guard(0.0);
  if (guard_nm < hidden_nm) return hides(guard_nm, hidden_nm, "moment", "nm");
  if (guard_nm > s.touch_nm()) return "";
  return " = " + format_number(guard_nm) + " is not above sensing.touch_nm = " + format_number(s.touch_nm()) +
         ": the guard begins when a contact is detected";
}

std::string too_soft(const proto::SlaveConfig& config) {
  constexpr double kLeast_n_per_m =
      1000.0;  // metal sheet, plastics, a hand with its arm: softer walls are rare
  const double k = config.command().guard_stiffness_n_per_m();
  if (!config.sensing().force() || k >= kLeast_n_per_m) return "";
  return " = " + format_number(k) + " is below " + format_number(kLeast_n_per_m) +
         " N/m: the force on an ordinary wall would pass the force guard; set it to at least that value";
}

std::string unmeasured_force(const proto::SlaveConfig& config) {
  return not_above(config.sensing().force_range_n(), "force_guard_n", config.command().force_guard_n());
}

std::string unmeasured_moment(const proto::SlaveConfig& config) {
  if (!config.sensing().force() || !config.sensing().moment()) return "";
  return not_above(config.sensing().moment_range_nm(), "moment_guard_nm", config.command().moment_guard_nm());
}

}  // namespace longreach
