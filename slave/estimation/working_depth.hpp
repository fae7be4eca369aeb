#pragma once
// The depth that the stiffness is told for: where the operator is expected to work, that of the working
// force, so that the value does not chase every movement. Where the low-passed depth leaves p/4..4p, it is
// taken instead and held in the same way.

#include <algorithm>
#include <cmath>

namespace longreach {

class WorkingDepth {
 public:
  void begin() { filtered_m_ = left_m_ = 0.0; }

  /// `working_m`: depth of the working force.
  [[nodiscard]] double depth_m(double working_m) const { return left_m_ > 0.0 ? left_m_ : working_m; }

  /// While the contact is known. `present_m`: depth now; `filter_s` > 0.
  void follow(double working_m, double present_m, double filter_s, double dt) {
    const double told_m = depth_m(working_m);
    if (filtered_m_ <= 0.0) filtered_m_ = told_m;
    filtered_m_ -= std::expm1(-dt / filter_s) * (std::max(present_m, 0.0) - filtered_m_);
    const bool left = filtered_m_ > kBand * told_m || filtered_m_ * kBand < told_m;
    if (left && filtered_m_ > 0.0) left_m_ = filtered_m_;
  }

 private:
  static constexpr double kBand = 4.0;
  double filtered_m_ = 0.0;  // 0: none yet
  double left_m_ = 0.0;      // gone to instead of the working force's; 0: none
};

}  // namespace longreach
