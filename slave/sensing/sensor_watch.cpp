#include "slave/sensing/sensor_watch.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kNoSensor_n = 1e5;      // more than any wrist sensor or arm of this kind bears
constexpr double kLever_m = 10.0;        // of a moment: likewise
constexpr double kHard_n_per_m = 1e7;    // steel on steel
constexpr double kComing_m_per_s = 0.1;  // of a wall
constexpr double kGuardNoise = 10.0;     // deviations
constexpr double kLong_s = 0.05;         // saturated, frozen
constexpr double kMoved_m = 1e-3;        // a sensor with noise has changed its last digit
constexpr double kStuck_s = 0.25;        // longer than an adapter stalls, at least 30 samples at 125 Hz
constexpr double kSample_s = 0.02;       // the longest time that one sample can stand for: the watchdog's
constexpr double kSame = 1e-9;           // rounding of rotations, there and back

double largest(const Vector3& v) { return v.cwiseAbs().maxCoeff(); }

// How far a force is from what it was, or from anything between that and none.
double leap_n(const Vector3& before_n, const Vector3& now_n) {
  const double size = before_n.squaredNorm();
  const double share = size > 0.0 ? std::clamp(now_n.dot(before_n) / size, 0.0, 1.0) : 0.0;
  return (now_n - share * before_n).stableNorm();
}

}  // namespace

void SensorWatch::configure(const SensingConfig& sensing, const CommandConfig& command) {
  sensing_ = sensing;
  command_ = command;
}

bool SensorWatch::in_range(const Wrench& reading) const {
  const double tool_n =
      2.0 * sensing_.tool.mass_kg * (sensing_.gravity_m_per_s2.norm() + command_.acceleration_max_m_per_s2);
  const double force_n = sensing_.force_range_n > 0.0 ? sensing_.force_range_n + sensing_.force_resolution_n
                                                      : kNoSensor_n + tool_n;
  const double moment_nm = sensing_.moment_range_nm > 0.0
                               ? sensing_.moment_range_nm + sensing_.moment_resolution_nm
                               : kLever_m * (kNoSensor_n + tool_n);
  return largest(reading.force) <= force_n * (1.0 + kSame) &&
         largest(reading.moment) <= moment_nm * (1.0 + kSame);
}

bool SensorWatch::saturates(const Wrench& reading) const {
  const double range_n = sensing_.force_range_n;
  return range_n > 0.0 && largest(reading.force) >= range_n * (1.0 - kSame) - sensing_.force_resolution_n;
}

bool SensorWatch::noisy_force() const { return sensing_.force_noise_n > 0.5 * sensing_.force_resolution_n; }

bool SensorWatch::noisy_moment() const {
  return measures_moment(sensing_) && sensing_.moment_noise_nm > 0.5 * sensing_.moment_resolution_nm;
}

Reason SensorWatch::constant() const {
  constexpr double kForce = 0.0, kMoment = 1.0;
  const bool force = sensing_.force && noisy_force() && !force_.varied();
  const bool moment = noisy_moment() && !moment_.varied();
  if (!force && !moment) return {};
  if (force_.seen_s() < kStuck_s) return HoldCause::kSensorZeroing;
  return {HoldCause::kSensorConstant, 0, force ? kForce : kMoment, 0.0};
}

void SensorWatch::Repetition::step(const Vector3& reading, const Motion& motion, double moved_m) {
  const double elapsed_s = motion.elapsed_s;
  const double rounding = kSame * std::max(largest(reading), before_ ? largest(*before_) : 0.0);
  if (before_) seen_s_ += std::min(elapsed_s, kSample_s);
  const Vector3 reading_W = motion.q_WE * reading;
  const bool same_W = largest(reading_W - before_W_) <= rounding;
  before_W_ = reading_W;
  bool same = before_.has_value();
  for (int i = 0; i < 3 && before_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool repeats = same_W || std::abs(reading[i] - (*before_)[i]) <= rounding;
    varied_[k] = varied_[k] || !repeats;
    stuck_s_[k] = repeats && varied_[k] ? stuck_s_[k] + std::min(elapsed_s, kSample_s) : 0.0;
    same = same && repeats;
  }
  same_s_ = same ? same_s_ + elapsed_s : 0.0;
  same_m_ = same ? same_m_ + moved_m : 0.0;
  before_ = reading;
}

bool SensorWatch::Repetition::faulty() const {
  const bool frozen = varied() && same_s_ > kLong_s && same_m_ > kMoved_m;
  return frozen || std::ranges::max(stuck_s_) > kStuck_s;
}

bool SensorWatch::read(const Wrench& reading, const Motion& motion) {
  if (!reading.force.allFinite() || !reading.moment.allFinite() || !in_range(reading)) return false;
  saturated_s_ = saturates(reading) ? saturated_s_ + motion.elapsed_s : 0.0;
  const double moved_m = p_WE_ ? (motion.p_WE - *p_WE_).norm() : 0.0;
  p_WE_ = motion.p_WE;
  force_.step(reading.force, motion, moved_m);
  moment_.step(reading.moment, motion, moved_m);
  return saturated_s_ <= kLong_s && !(noisy_force() && force_.faulty()) &&
         !(noisy_moment() && moment_.faulty());
}

bool SensorWatch::felt(const Vector3& force_n, const Motion& motion, double uncertainty_n) {
  const bool leaps = felt_ && leap_n(*felt_, force_n) > leap_max_n(motion) + uncertainty_n;
  felt_ = force_n;
  return !leaps;
}

double SensorWatch::leap_max_n(const Motion& motion) const {
  const double contact_n_per_s =
      kHard_n_per_m * motion.speed_m_per_s + command_.guard_stiffness_n_per_m * kComing_m_per_s;
  return command_.force_guard_n + kGuardNoise * sensing_.force_noise_n + 2.0 * sensing_.force_resolution_n +
         motion.elapsed_s * contact_n_per_s;
}

}  // namespace longreach
