#include "slave/sensing/sensor_watch.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kNoSensor_n = 1e5;      // more than any wrist sensor or arm of this kind bears
constexpr double kLever_m = 10.0;        // of a moment: likewise
constexpr double kHard_n_per_m = 1e7;    // steel on steel
constexpr double kComing_m_per_s = 0.1;  // of a wall
constexpr double kGuardNoise = 10.0;     // deviations
constexpr double kLong_s = 0.05;         // saturated, frozen
constexpr double kMoved_m = 1e-3;        // a sensor with noise has changed its last digit
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

bool SensorWatch::repeats(const Wrench& reading) const {
  const bool noisy = sensing_.force_noise_n > 0.5 * sensing_.force_resolution_n;
  return noisy && read_ && !reading.force.isZero(0.0) &&
         largest(reading.force - read_->force) <= kSame * largest(reading.force);
}

bool SensorWatch::read(const Wrench& reading, const Motion& motion) {
  if (!reading.force.allFinite() || !reading.moment.allFinite() || !in_range(reading)) return false;
  saturated_s_ = saturates(reading) ? saturated_s_ + motion.elapsed_s : 0.0;
  const bool same = repeats(reading);
  same_s_ = same ? same_s_ + motion.elapsed_s : 0.0;
  same_m_ = same ? same_m_ + (motion.p_WE - p_WE_).norm() : 0.0;
  read_ = reading;
  p_WE_ = motion.p_WE;
  return saturated_s_ <= kLong_s && !(same_s_ > kLong_s && same_m_ > kMoved_m);
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
