#pragma once
// Detects that a limit other than speed keeps the tool from its goal: the played goal has been farther from
// the tool than `least` along the direction of the limit for 0.1 s while the limit was active and the tool
// was at rest, which is not the case where the guard only slows it down. One instance for the position of the
// tool (m), one for its rotation (rad).

#include <cmath>
#include <optional>

#include "common/spatial/spatial.hpp"

namespace longreach {

class HeldBack {
 public:
  explicit HeldBack(double least) : least_(least) {}

  void reset() { *this = HeldBack(least_); }

  /// `place`: position of the tool, relative to any fixed point; `missing`: from it to the goal, in W, m or
  /// rotation vector; `limited`: such a limit is active in this tick; `along`: unit direction of the limit;
  /// zero if unknown: towards the goal.
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

  /// Unit, in W, towards the goal; zero: no limit holds the tool back.
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
