#pragma once
// Detects that the tool has stopped approaching a goal that is at rest. The distance between two poses is
// √((L φ)² + |Δp|²) where φ is the angle between them and L = Kinematics::motion_length_m.

#include <cmath>
#include <limits>
#include <optional>

#include "common/spatial/spatial.hpp"

namespace longreach {

class StallDetector {
 public:
  static constexpr double kMoved = 1e-3;  // a goal that moves by less than this share of L counts as at rest
  static constexpr double kThere = 2e-3;  // a tool within this share of L has reached the goal

  explicit StallDetector(double length_m) : length_m_(length_m) {}

  void reset() { X_WE_goal_.reset(); }

  /// Returns true if the tool has not reached a goal at rest and has not come closer to it for kStallS. `dt`
  /// in s.
  [[nodiscard]] bool ends(const Pose& X_WE, const Pose& X_WE_goal, double dt) {
    constexpr double kStallS = 3.0, kNearer = 1e-4;  // kNearer: minimum progress, as a share of L
    if (!X_WE_goal_ || !(distance_m(*X_WE_goal_, X_WE_goal) <= kMoved * length_m_)) {
      X_WE_goal_ = X_WE_goal;
      least_m_ = std::numeric_limits<double>::infinity();
    }
    const double now_m = distance_m(X_WE, X_WE_goal);
    since_s_ += dt;
    if (now_m < least_m_ - kNearer * length_m_) least_m_ = now_m, since_s_ = 0.0;
    return since_s_ >= kStallS && now_m > kThere * length_m_;
  }

 private:
  [[nodiscard]] double distance_m(const Pose& a, const Pose& b) const {
    return std::hypot(length_m_ * log_rotation(a.q * b.q.conjugate()).norm(), (a.p - b.p).norm());
  }

  double length_m_;
  std::optional<Pose> X_WE_goal_{};
  double least_m_ = 0.0;
  double since_s_ = 0.0;
};

}  // namespace longreach
