#pragma once
// The branches of a closed form as they are found: two ways at each square root, and six angles at the end of
// each way. If only the nearest branch is wanted, the nearer way is taken first, and another one is left out
// when its angle alone is farther off than what was found.

#include <algorithm>
#include <limits>
#include <utility>

#include "common/spatial/arc_tangent.hpp"
#include "common/spatial/sin_cos.hpp"
#include "slave/robot/closed_inverse.hpp"
#include "slave/robot/turn.hpp"

namespace longreach {

class BranchTree {
 public:
  using Role = ArmLoop::Role;

  BranchTree(const ArmLoop& loop, const JointVector& before_rad, Branches& out, bool nearest)
      : joint_(loop.joint), before_rad_(before_rad), out_(out), nearest_(nearest) {
    out.count = 0;
  }

  /// Both of two solutions for one angle.
  template <typename Then>
  void fork(Role role, const Turn& one, const Turn& other, const Then& then) {
    if (!nearest_ || probing_) {
      then(one);
      then(other);
      return;
    }
    const Turn here = before(role);
    const double like_one = likeness(one, here), like_other = likeness(other, here);
    then(like_one >= like_other ? one : other);
    if (!too_far(std::min(like_one, like_other))) then(like_one >= like_other ? other : one);
  }

  [[nodiscard]] bool too_far(Role role, const Turn& t) const {
    return nearest_ && too_far(likeness(t, before(role)));
  }

  /// The turn from one vector to another; where one of them vanishes, the angle before.
  [[nodiscard]] Turn direction(const Plane& from, const Plane& to, Role role) const {
    const double square = from.x * from.x + from.y * from.y, other = to.x * to.x + to.y * to.y;
    if (!(std::min(square, other) > kFreeSquare)) return before(role);
    const double scale = 1.0 / sqrt(square * other);
    return {(from.x * to.x + from.y * to.y) * scale, (from.x * to.y - from.y * to.x) * scale};
  }

  [[nodiscard]] Turn before(Role role) const {
    const LoopJoint& j = joint_[role];
    const SinCos t = sin_cos(j.sign * (before_rad_[j.joint] + j.theta_rad));
    return {t.c, t.s};
  }

  /// Least miss of the branches that `then` finds, which are not kept.
  template <typename Then>
  [[nodiscard]] double probe(const Then& then) {
    const double before = std::exchange(least_miss_, std::numeric_limits<double>::infinity());
    probing_ = true;
    then();
    probing_ = false;
    return std::exchange(least_miss_, before);
  }

  void set(Role role, const Turn& t) { cos_[role] = t.c, sin_[role] = t.s; }

  void add(double miss) {
    least_miss_ = std::min(least_miss_, miss);
    if (probing_) return;
    if (out_.count == Branches::kMax || (nearest_ && miss > ClosedInverse::kMissMax)) return;
    double angle[6];
    arc_tangents(sin_, cos_, angle);
    Branch& branch = out_.branch[nearest_ ? 0 : static_cast<std::size_t>(out_.count)];
    JointVector joint_rad;
    for (std::size_t role = 0; role < 6; ++role) {
      const LoopJoint& j = joint_[role];
      joint_rad[j.joint] = j.sign * angle[role] - j.theta_rad;
    }
    if (nearest_) {
      double square = 0.0;
      for (int i = 0; i < kMaxJoints; ++i) {
        const double change = nearest_turn(joint_rad[i] - before_rad_[i]);
        joint_rad[i] = before_rad_[i] + change;
        square += change * change;
      }
      if (!(square < found_)) return;
      found_ = square;
      out_.count = 0;
    }
    branch.joint_rad = joint_rad;
    branch.miss = miss;
    ++out_.count;
  }

 private:
  [[nodiscard]] bool too_far(double likeness) const { return 2.0 * (1.0 - likeness) >= found_; }  // <= x²
  static constexpr double kFreeSquare = ClosedInverse::kFree * ClosedInverse::kFree;

  const std::array<LoopJoint, 6>& joint_;
  const JointVector& before_rad_;
  Branches& out_;
  bool nearest_, probing_ = false;
  double least_miss_ = std::numeric_limits<double>::infinity();
  double found_ = std::numeric_limits<double>::infinity();  // Σ Δq² of the nearest so far, rad²
  double sin_[6], cos_[6];                                  // by role
};

}  // namespace longreach
