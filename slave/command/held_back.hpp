#pragma once
// Detects that a limit other than a speed limit keeps the tool from its goal: for 0.1 s the limit was active,
// the tool was at rest along the direction of the limit, and in that direction the goal from the playout was
// more than `least` away from the tool. A tool that the guard only slows down is not at rest. One instance
// handles the position of the tool (m), and another handles its rotation (rad).

#include <cmath>
#include <optional>

#include "common/spatial/spatial.hpp"

namespace longreach {

class HeldBack {
 public:
  explicit HeldBack(double least) : least_(least) {}

  void reset() { *this = HeldBack(least_); }

  /// `place`: position of the tool, relative to any fixed point. `missing`: vector from the tool to its goal
  /// in W, m or a rotation vector. `limited`: such a limit is active in this tick. `along`: unit direction of
  /// the limit, or zero if it is unknown; the direction to the goal is then used.
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

  /// Unit vector in W towards the goal; zero if no limit holds the tool back.
  [[nodiscard]] const Vector3& direction() const { return direction_; }

 private:
  /// Speed below which a tool counts as at rest, in multiples of `least` per second: 4 mm/s for 2 mm.
  static constexpr double kStands_share_per_s = 2.0;

  double least_;
  std::optional<Vector3> place_{};
  Vector3 velocity_ = Vector3::Zero();  // low-pass filtered velocity of the tool
  double far_s_ = 0.0, limited_s_ = 0.0;
  Vector3 direction_ = Vector3::Zero();
};

}  // namespace longreach
