#pragma once
// Tests whether the sensor or the contact causes an unexpected growth of the force. The robot brakes, and the
// test observes how the force changes. If the sensor is faulty, the wall is at rest, and the force changes only
// while the robot moves. An approaching wall continues to push the tool. The force of a carried object ends with
// the motion. The change of the force is evaluated after 60 ms, over the whole time and over the last 20 ms:
//   ΔF = slope d·Δp ± (0.15 N or 3 σ, and 30 %)      the force grows as before, so sign or frame of the
//                                                    sensor is wrong; this is decided as soon as an
//                                                    approaching wall would differ by twice that tolerance
//   otherwise, it grows at rest (force_answer.hpp)   approaching wall: the response to a retreat is evaluated
//   otherwise, after 150 ms or that duration         force persists
// Growth during motion perpendicular to the force can also be caused by a surface stiffer than k_max on which
// the tool slides. If the force stops growing, such a surface is the cause. Otherwise the tool retreats along
// the force by 0.1 mm. If there is such a surface, the force then decreases by more than k_max times half
// that distance, or the contact ends. Either result, at any time, clears the sensor of suspicion.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slave/sensing/growth_watch.hpp"

namespace longreach {

class ForceSignTest {
 public:
  enum class Verdict : std::uint8_t { kNone, kPending, kSign, kForcePersists };

  /// Starts the test unless it is already running. While the test is pending, the robot must brake and may
  /// move only at ease_m_per_s().
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

  /// Processes one tick. `reaction` is the unit vector in the direction of the force on the tool, and `bounds`
  /// are the bounds of `growth`. `dt` is in s. `grows` is true if the force grows while the robot is at rest.
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
  /// Speed of the retreat along the force that the test requires, m/s.
  [[nodiscard]] double ease_m_per_s() const { return pending() && easing_ ? kEase_m_per_s : 0.0; }

 private:
  static constexpr double kTrial_s = 0.06;
  static constexpr double kLast_s = 0.02;
  static constexpr double kGrows_s = 0.15;  // time needed to detect growth at rest
  static constexpr double kChange_n = 0.15;
  static constexpr double kNoise = 3.0;
  static constexpr double kShare = 0.3;
  /// Required force difference between an approaching and a resting wall, in multiples of the tolerance.
  static constexpr double kShown = 2.0;
  /// Required growth at rest, in multiples of change().
  static constexpr double kGrown = 4.0;
  static constexpr double kEase_m = 1e-4;
  static constexpr double kEase_m_per_s = 2e-3;
  static constexpr double kEaseMax_s = 0.5;
  static constexpr double kAnswer = 0.5;  // as a fraction of k_max

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
  /// Returns whether the two cases are distinguishable. When the robot is at rest, the force of an
  /// approaching wall grows at least as fast as before, although the tool moved back. It therefore grows
  /// clearly more than the force of a wall at rest that is measured with the wrong sign.
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
  bool otherwise_ = false;  // the force changed differently than before the test
  double time_s_ = 0.0, slope_n_per_m_ = 0.0, n_per_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();  // direction of the growth, later of the retreat
  Point from_{}, last_{};
};

}  // namespace longreach
