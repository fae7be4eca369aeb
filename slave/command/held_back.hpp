#pragma once
// Whether a limit other than speed keeps the tool from its goal: the goal as played out has been farther
// from the tool than `least` along the limit's direction for 0.1 s while the limit acted and the tool stood,
// as it does not where the guard only makes it slower. Once for the place of the tool (m), once for its
// rotation (rad).

#include <cmath>
#include <optional>

#include "common/spatial/spatial.hpp"

namespace longreach {

class HeldBack {
 public:
  explicit HeldBack(double least) : least_(least) {}

  void reset() { *this = HeldBack(least_); }

  /// `place`: of the tool, from anywhere that rests; `missing`: from it to the goal, in W, m or rotation
  /// vectors; `limited`: such a limit acts in this tick; `along`: unit, in which it acts; zero where that is
  /// not known: towards the goal.
  void step(const Vector3& place, const Vector3& missing, bool limited, const Vector3& along, double dt) {
    constexpr double kAfter_s = 0.1, kRemember_s = 0.05, kMean_s = 0.05;
    limited_s_ = limited ? kRemember_s : limited_s_ - dt;
    if (place_) velocity_ += -std::expm1(-dt / kMean_s) * ((place - *place_) / dt - velocity_);
    place_ = place;
    const double distance = norm(missing);
    const Vector3 towards = along.isZero(0.0) && distance > 0.0 ? Vector3(missing / distance) : along;
    const bool stands = towards.dot(velocity_) < kStands_share_per_s * least_;
    const bool far = towards.dot(missing) > least_ && limited_s_ > 0.0 && stands;
    far_s_ = far ? far_s_ + dt : 0.0;
    direction_ = far_s_ >= kAfter_s ? towards : Vector3::Zero();
  }

  /// Unit, in W, towards the goal; zero: nothing holds the tool back.
  [[nodiscard]] const Vector3& direction() const { return direction_; }

 private:
  static constexpr double kStands_share_per_s = 2.0;  // of `least`: 4 mm/s

  double least_;
  std::optional<Vector3> place_{};
  Vector3 velocity_ = Vector3::Zero();  // of the tool, smoothed
  double far_s_ = 0.0, limited_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
};

}  // namespace longreach
