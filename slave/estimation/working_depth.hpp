#pragma once
// The depth that the stiffness is told for: that of a usual force at first, so that the value does not chase
// every movement, then where the hand works, the mean of about the last `memory_s`. It is held until the
// tangent there is off the law's force at the mean by over a fifth of that.

#include <algorithm>
#include <cmath>

namespace longreach {

class WorkingDepth {
 public:
  void begin() { mean_m_ = told_m_ = 0.0; }

  /// `usual_m`: depth of the usual force.
  [[nodiscard]] double depth_m(double usual_m) const { return told_m_ > 0.0 ? told_m_ : usual_m; }

  /// While the contact is known, with this exponent. `present_m`: depth now; `memory_s` > 0.
  void follow(double usual_m, double present_m, double exponent, double memory_s, double dt) {
    const double held_m = depth_m(usual_m);
    if (mean_m_ <= 0.0) mean_m_ = held_m;
    mean_m_ -= std::expm1(-dt / memory_s) * (std::max(present_m, 0.0) - mean_m_);
    const double depth = mean_m_ / held_m, force = std::pow(depth, exponent);
    const double off = std::abs(1.0 + exponent * (depth - 1.0) - force);
    if (off > kOff * force && mean_m_ > 0.0) told_m_ = mean_m_;
  }

 private:
  static constexpr double kOff = 0.2;
  double mean_m_ = 0.0;  // 0: none yet
  double told_m_ = 0.0;  // gone to instead of the usual force's; 0: none
};

}  // namespace longreach
