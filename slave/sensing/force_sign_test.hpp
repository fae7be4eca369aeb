#pragma once
// The force grows on a way that should not make it grow: is it the sensor, or what is touched? The robot
// brakes, and the force tells. A wall that was pressed by a robot with a wrong sensor rests with it; a wall
// that comes goes on to push, and what a carried body does in motion ends with the motion. After 60 ms, over
// all of them and over the last 20 ms,
//   ΔF = slope d·Δp ± (0.15 N or 3 σ, and 30 %)   as it grew before: sign or frame of the sensor, but not
//                                                 before what comes would differ by twice that tolerance
//   else it grows at rest (force_answer.hpp)      a wall that comes: its answer decides
//   else, after 150 ms, or as long as that takes  no relief
// What grew across the force could be a surface stiffer than k_max, too, on which the tool slides. If it does
// not go on to grow, it is. Else the tool gives way along the force by 0.1 mm: from such a surface the force
// falls by more than k_max does on half of that way, or the contact ends. That acquits at any time.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slave/sensing/growth_watch.hpp"

namespace longreach {

class ForceSignTest {
 public:
  enum class Verdict : std::uint8_t { kNone, kPending, kSign, kForcePersists };

  /// Unless it has begun. While it is pending the robot must brake, but for ease_m_per_s().
  void begin(const GrowthWatch& growth) {
    if (verdict_ != Verdict::kNone) return;
    verdict_ = Verdict::kPending;
    direction_ = growth.direction();
    slope_n_per_m_ = growth.slope_n_per_m();
    n_per_s_ = growth.n_per_s();
    across_ = growth.across();
    from_ = {growth.place_m(), growth.size_n()};
  }
  void reset() { *this = {}; }

  /// `reaction`: unit, of the force on the tool; `bounds` those of `growth`; dt in s.
  /// `grows`: at rest.
  void step(const GrowthWatch& growth, const Vector3& reaction, const GrowthBounds& bounds, double dt,
            bool grows = false) {
    if (verdict_ != Verdict::kPending) return;
    if (!growth.in_contact()) return reset();
    const Point now{growth.place_m(), growth.size_n()};
    if (time_s_ < kTrial_s - kLast_s) last_ = now;
    time_s_ += dt;
    if (easing_) {
      see_answer(now, bounds);
    } else if (time_s_ >= kTrial_s) {
      see_rest(now, reaction, bounds, grows);
    }
  }
  [[nodiscard]] Verdict verdict() const { return verdict_; }
  /// Speed along the force that the tool shall give way with.
  [[nodiscard]] double ease_m_per_s() const { return pending() && easing_ ? kEase_m_per_s : 0.0; }

 private:
  static constexpr double kTrial_s = 0.06;
  static constexpr double kLast_s = 0.02;
  static constexpr double kGrows_s = 0.15;  // till a growth at rest is known
  static constexpr double kChange_n = 0.15;
  static constexpr double kNoise = 3.0;
  static constexpr double kShare = 0.3;
  static constexpr double kShown = 2.0;  // tolerances that what comes and what rests differ by
  static constexpr double kGrown = 4.0;  // changes, so that growth at rest is known
  static constexpr double kEase_m = 1e-4;
  static constexpr double kEase_m_per_s = 2e-3;
  static constexpr double kEaseMax_s = 0.5;
  static constexpr double kAnswer = 0.5;  // of k_max

  struct Point {
    Vector3 p_m = Vector3::Zero();
    double force_n = 0.0;
  };
  [[nodiscard]] bool pending() const { return verdict_ == Verdict::kPending; }
  [[nodiscard]] static double change(double noise_n) { return std::max(kChange_n, kNoise * noise_n); }
  [[nodiscard]] double expected(const Point& then, const Point& now) const {
    return slope_n_per_m_ * direction_.dot(now.p_m - then.p_m);
  }
  [[nodiscard]] static double tolerance(double expected_n, double noise_n) {
    return change(noise_n) + kShare * std::abs(expected_n);
  }
  [[nodiscard]] bool as_before(const Point& then, const Point& now, double noise_n) const {
    const double expected_n = expected(then, now);
    return std::abs(now.force_n - then.force_n - expected_n) <= tolerance(expected_n, noise_n);
  }
  /// A wall that comes grows at rest by no less than before, while the tool went back: by clearly more than a
  /// wall at rest under a wrong sensor does.
  [[nodiscard]] bool distinguishes(const Point& now, double noise_n) const {
    const double expected_n = expected(from_, now);
    return n_per_s_ * time_s_ - expected_n >= kShown * tolerance(expected_n, noise_n);
  }
  void see_rest(const Point& now, const Vector3& reaction, const GrowthBounds& bounds, bool grows) {
    const bool as_grown =
        !otherwise_ && as_before(from_, now, bounds.noise_n) && as_before(last_, now, bounds.noise_n);
    if (as_grown && !distinguishes(now, bounds.noise_n)) return;
    if (!across_ && as_grown) {
      verdict_ = Verdict::kSign;
    } else if (!as_grown && (across_ || grows)) {
      reset();
    } else if (!across_) {
      otherwise_ = true;
      if (time_s_ >= kGrows_s && n_per_s_ * time_s_ >= kGrown * change(bounds.noise_n))
        verdict_ = Verdict::kForcePersists;
    } else {
      easing_ = true;
      direction_ = reaction;
      from_ = now;
    }
  }
  void see_answer(const Point& now, const GrowthBounds& bounds) {
    const double fell_n = from_.force_n - now.force_n;
    const double answer_n = std::max(kAnswer * bounds.stiffness_n_per_m * kEase_m, kNoise * bounds.noise_n);
    if (fell_n >= answer_n) {
      reset();
    } else if (direction_.dot(now.p_m - from_.p_m) >= kEase_m) {
      verdict_ = Verdict::kSign;
    } else if (time_s_ > kTrial_s + kEaseMax_s) {
      verdict_ = Verdict::kForcePersists;
    }
  }

  Verdict verdict_ = Verdict::kNone;
  bool across_ = false, easing_ = false;
  bool otherwise_ = false;  // than it grew before
  double time_s_ = 0.0, slope_n_per_m_ = 0.0, n_per_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();  // of the growth; then of giving way
  Point from_{}, last_{};
};

}  // namespace longreach
