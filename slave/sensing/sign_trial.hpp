#pragma once
// The force grows on a way that should not make it grow: is it the sensor, or what is touched? The robot
// brakes, and the force tells. A wall that was pressed by a robot with a wrong sensor rests with it; a wall
// that comes goes on to push, and what a carried body does in motion ends with the motion. After 60 ms, over
// all of them and over the last 20 ms,
//   ΔF = slope d·Δp ± (0.15 N or 3 σ, and 30 %)   as it grew before: sign or frame of the sensor
//   else, or where a stiff surface could do it    no relief

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slave/sensing/growth_watch.hpp"

namespace longreach {

class SignTrial {
 public:
  enum class Verdict : std::uint8_t { kNone, kPending, kSign, kNoRelief };

  /// Unless it has begun. While it is pending the robot must brake.
  void begin(const GrowthWatch& growth) {
    if (verdict_ != Verdict::kNone) return;
    verdict_ = Verdict::kPending;
    direction_ = growth.direction();
    slope_n_per_m_ = growth.slope_n_per_m();
    may_be_stiff_ = growth.may_be_stiff();
    from_ = {growth.place_m(), growth.size_n()};
  }
  void reset() { *this = {}; }

  /// `noise_n` of the sensor; dt in s.
  void step(const GrowthWatch& growth, double noise_n, double dt) {
    if (verdict_ != Verdict::kPending) return;
    const Point now{growth.place_m(), growth.size_n()};
    if (time_s_ < kTrial_s - kLast_s) last_ = now;
    time_s_ += dt;
    if (time_s_ < kTrial_s) return;
    const bool as_grown = as_before(from_, now, noise_n) && as_before(last_, now, noise_n);
    verdict_ = as_grown && !may_be_stiff_ ? Verdict::kSign : Verdict::kNoRelief;
  }
  [[nodiscard]] Verdict verdict() const { return verdict_; }

 private:
  static constexpr double kTrial_s = 0.06;
  static constexpr double kLast_s = 0.02;
  static constexpr double kChange_n = 0.15;
  static constexpr double kNoise = 3.0;
  static constexpr double kShare = 0.3;

  struct Point {
    Vector3 p_m = Vector3::Zero();
    double force_n = 0.0;
  };
  [[nodiscard]] bool as_before(const Point& then, const Point& now, double noise_n) const {
    const double expected_n = slope_n_per_m_ * direction_.dot(now.p_m - then.p_m);
    const double may_n = std::max(kChange_n, kNoise * noise_n) + kShare * std::abs(expected_n);
    return std::abs(now.force_n - then.force_n - expected_n) <= may_n;
  }

  Verdict verdict_ = Verdict::kNone;
  bool may_be_stiff_ = false;
  double time_s_ = 0.0, slope_n_per_m_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
  Point from_{}, last_{};
};

}  // namespace longreach
