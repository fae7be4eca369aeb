#pragma once
// The depth for which the stiffness is reported: the depth at which the operator works. At first it is the
// depth at the usual force of a hand, so that the value does not change during the approach. Later it is the
// mean depth over about the last `memory_s`; the depth is held until the tangent at the mean differs by more
// than 8 %, unless the tool oscillates about the held depth. While the tool oscillates, the held depth is the
// mean of a whole period; while the tool rests, it is the value to which the mean converges. In these two
// cases the tolerance is 2 % instead of 8 %.

#include <algorithm>
#include <cmath>

namespace longreach {

class WorkingDepth {
 public:
  void begin() { *this = WorkingDepth(); }
  /// Restarts at the current depth after the contact has changed during a touch.
  void begin_at(double present_m) {
    begin();
    held_m_ = std::max(present_m, 0.0);
  }
  /// Call this when the tool has left the surface and may return. The depth is then limited to the usual
  /// depth, because a tangent at a greater depth has its foot farther behind the surface and would be
  /// displayed too late. Stiffening the spring while it is compressed would take energy that is not available.
  void leave(double usual_m) {
    const double held_m = std::min(held_m_, usual_m);
    begin();
    held_m_ = held_m;
  }

  /// Returns the depth to report; `usual_m`: depth at the usual force of a hand, m.
  [[nodiscard]] double depth_m(double usual_m) const { return held_m_ > 0.0 ? held_m_ : usual_m; }

  /// Call this in every tick in which the contact is identified. `exponent` is the exponent of the contact
  /// law, and `present_m` the current depth; `memory_s` > 0. Returns true if the held depth changed.
  bool follow(double usual_m, double present_m, double exponent, double memory_s, double dt) {
    const double held_m = depth_m(usual_m), now_m = std::max(present_m, 0.0);
    if (!begun_) mean_m_ = now_m;
    begun_ = true;
    const double share = -std::expm1(-dt / memory_s), from_mean_m = now_m - mean_m_;
    mean_m_ += share * from_mean_m;
    variance_m2_ += share * (from_mean_m * from_mean_m - variance_m2_);
    held_s_ += dt;
    const double swing_m = kSwing * std::sqrt(variance_m2_);
    const auto off = [&](double depth) { return std::abs(std::pow(depth / held_m, exponent - 1.0) - 1.0); };
    if (const double swung_m = swing(now_m, swing_m, dt); swung_m > 0.0 && off(swung_m) > kSlightlyOff)
      return hold(swung_m);
    const bool there = std::abs(from_mean_m) < kThere * mean_m_;
    const bool within = std::abs(mean_m_ - held_m) < swing_m;
    if (there && held_s_ > memory_s && !within && off(mean_m_) > kOff) return hold(mean_m_);
    const bool rests = swing_s_ > kRests * memory_s && held_s_ > memory_s;
    return rests && off(mean_m_) > kSlightlyOff && hold(mean_m_);
  }

 private:
  static constexpr double kOff = 0.08, kSlightlyOff = 0.02;
  /// Duration without an oscillation after which the tool is considered at rest, in multiples of the memory.
  static constexpr double kRests = 2.5;
  /// Minimum amplitude of an oscillation, in standard deviations of the depth.
  static constexpr double kSwing = 0.5;
  /// A tool whose distance from the mean depth exceeds this fraction of the mean depth is only passing
  /// through.
  static constexpr double kThere = 0.3;

  bool hold(double depth_m) {
    if (!(depth_m > 0.0)) return false;
    held_m_ = depth_m;
    held_s_ = 0.0;
    return true;
  }

  /// Returns the mean depth of the period if an upward crossing of the mean ends it now, otherwise 0.
  double swing(double now_m, double swing_m, double dt) {
    swing_sum_ += now_m * dt;
    swing_s_ += dt;
    if (now_m < mean_m_ - swing_m) below_ = true;
    if (!below_ || now_m < mean_m_ + swing_m) return 0.0;
    const double depth_m = whole_ ? swing_sum_ / swing_s_ : 0.0;
    whole_ = true;
    below_ = false;
    swing_sum_ = swing_s_ = 0.0;
    return depth_m;
  }

  bool begun_ = false;
  double held_m_ = 0.0;  // depth that is held instead of the usual depth; 0: none
  double held_s_ = 0.0;  // time since the depth was last set
  double mean_m_ = 0.0, variance_m2_ = 0.0;
  /// `below_`: the depth was less than the mean in this period. `whole_`: the period is complete because it
  /// started at the end of the previous period.
  bool below_ = false, whole_ = false;
  /// Integral of the depth over the current period, m s, and the duration of the period, s.
  double swing_sum_ = 0.0, swing_s_ = 0.0;
};

}  // namespace longreach
