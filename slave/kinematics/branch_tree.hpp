#pragma once
// Search for the branches of a closed form: each square root has two alternatives, and each leaf has six
// angles. If only the nearest branch is wanted, the nearer alternative is tried first, and another one is
// skipped if one of its angles alone is farther away than the best result.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common/spatial/arc_tangent.hpp"
#include "slave/kinematics/closed_inverse.hpp"
#include "slave/kinematics/turn.hpp"

namespace longreach {

class BranchTree {
 public:
  using Role = ArmLoop::Role;
  static constexpr double kFreeSquare = ClosedInverse::kFree * ClosedInverse::kFree;

  BranchTree(const ArmLoop& loop, const KnownJoints& before, Branches& out, bool nearest)
      : joint_(loop.joint), before_(before), out_(out), miss_max_(loop.miss_max), nearest_(nearest) {
    out.count = 0;
  }

  /// Tries both signs of the sine of `aside` (>= 0), first the one on the side of `here`, which is the
  /// previous angle relative to the angle midway between the two alternatives.
  template <typename Then>
  void fork(const Turn& here, const Turn& aside, const Then& then) {
    const Turn nearer{aside.c, std::copysign(aside.s, here.s)};
    then(nearer);
    if (!nearest_ || probing_ || !too_far(likeness(reversed(nearer), here))) then(reversed(nearer));
  }

  [[nodiscard]] bool too_far(Role role, const Turn& t) const {
    return nearest_ && too_far(likeness(t, before(role)));
  }

  /// Returns the rotation from one vector to another, or the previous angle if one of them vanishes.
  [[nodiscard]] Turn direction(const Plane& from, const Plane& to, Role role) const {
    const double square = from.x * from.x + from.y * from.y, other = to.x * to.x + to.y * to.y;
    if (!(std::min(square, other) > kFreeSquare)) return before(role);
    const double scale = 1.0 / sqrt(square * other);
    return {(from.x * to.x + from.y * to.y) * scale, (from.x * to.y - from.y * to.x) * scale};
  }

  [[nodiscard]] Turn before(Role role) const { return {before_.cos[role], before_.sin[role]}; }

  /// Returns the minimum miss of the branches that `then` finds; these branches are not kept.
  template <typename Then>
  [[nodiscard]] double probe(const Then& then) {
    const double before = std::exchange(least_miss_, std::numeric_limits<double>::infinity());
    probing_ = true;
    then();
    probing_ = false;
    return std::exchange(least_miss_, before);
  }

  void set(Role role, const Turn& t) { cos_[role] = t.c, sin_[role] = t.s; }

  /// Adds the branch with the current angles unless it is worse than the best one.
  void add(double miss) {
    least_miss_ = std::min(least_miss_, miss);
    if (probing_) return;
    if (out_.count == Branches::kMax || (nearest_ && miss > miss_max_)) return;
    double angle[6];
    angles(angle);
    if (nearest_) {
      double square = 0.0;
      for (const double a : angle) square += a * a;
      if (!(square < found_)) return;
      found_ = square;
      out_.count = 0;
    }
    Branch& branch = out_.branch[static_cast<std::size_t>(out_.count)];
    for (std::size_t role = 0; role < 6; ++role) {
      const LoopJoint& j = joint_[role];
      branch.joint_rad[j.joint] = before_.joint_rad[j.joint] + j.sign * angle[role];
    }
    branch.miss = miss;
    ++out_.count;
  }

  /// True if all branches are wanted and the branches that are found are kept.
  [[nodiscard]] bool all() const { return !nearest_ && !probing_; }

  /// Adds the last branch with a flipped wrist, d + π, -e, f + π, which a wrist with perpendicular axes also
  /// permits.
  void add_flipped() {
    if (out_.count == 0 || out_.count == Branches::kMax) return;
    Branch& flipped = out_.branch[static_cast<std::size_t>(out_.count)];
    flipped = out_.branch[static_cast<std::size_t>(out_.count - 1)];
    for (const Role role : {Role::kD, Role::kE, Role::kF}) {
      const LoopJoint& j = joint_[role];
      double& q = flipped.joint_rad[j.joint];
      const double turned = role == Role::kE ? -q - 2.0 * j.theta_rad : q + std::numbers::pi;
      q = before_.joint_rad[j.joint] + nearest_turn(turned - before_.joint_rad[j.joint]);
    }
    ++out_.count;
  }

 private:
  // Angles relative to the previous joints. Near the previous joints, the sine is sufficient.
  void angles(double (&angle)[6]) const {
    double s[6], c[6];
    for (std::size_t role = 0; role < 6; ++role) {
      s[role] = sin_[role] * before_.cos[role] - cos_[role] * before_.sin[role];
      c[role] = cos_[role] * before_.cos[role] + sin_[role] * before_.sin[role];
    }
    const double least = std::min(std::min(std::min(c[0], c[2]), c[4]), std::min(std::min(c[1], c[3]), c[5]));
    if (!(least >= kLike)) return arc_tangents(s, c, angle);
    for (std::size_t role = 0; role < 6; ++role) angle[role] = arc_of_small_sine(s[role]);
  }

  static constexpr double kLike = 0.996;  // above this cosine, the sine is within kSmallSine
  [[nodiscard]] bool too_far(double likeness) const { return 2.0 * (1.0 - likeness) >= found_; }  // <= x²
  const std::array<LoopJoint, 6>& joint_;
  const KnownJoints& before_;
  Branches& out_;
  double miss_max_;
  bool nearest_, probing_ = false;
  double least_miss_ = std::numeric_limits<double>::infinity();
  double found_ = std::numeric_limits<double>::infinity();  // Σ Δq² of the nearest branch so far, rad²
  double sin_[6], cos_[6];                                  // indexed by role
};

}  // namespace longreach
