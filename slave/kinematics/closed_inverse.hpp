#pragma once
// All joint angles for a tool pose in closed form, for arms whose loop arm_loop.hpp recognises.
//
// The loop leaves two equations in one angle c and one more, β:
//   a X = x(c),  sin α Y = y(c),  (X, Y) = Rot(β) r(c)          x, y, r: k + k' cos c + k'' sin c
// (spherical: the intersection point of the axes, seen from the axes a and b, β = φ_b; parallel: the common
// direction, likewise, β = -φ_a). With a = 0 or sin α = 0 one of them contains only c: two roots by the phase
// formula, then two of β; otherwise X² + Y² = r² is a trigonometric polynomial of second degree in c: up to
// four roots. The remainder is a wrist (two solutions) or a planar arm (two solutions): at most eight in
// total.
//
// Angles are computed as the direction of a vector, lengths as hypot, differences of squares as products: no
// acos. Where such a vector vanishes (below kFree) the pose does not determine the angle, and the previous
// joints do. Where the discriminant of a root is negative, the nearest real root is taken and `miss` gives
// the deviation. Near a singular pose a square root halves the digits of an angle: the caller improves the
// result by Newton steps (inverse.hpp). Joint limits are not considered.

#include <array>
#include <numbers>

#include "slave/kinematics/arm_loop.hpp"
#include "slave/kinematics/quartic_turns.hpp"

namespace longreach {

/// The present joints, which determine the branch. Computed once for all poses near them: the angles of
/// solutions near them need no arc tangent.
struct KnownJoints {
  JointVector joint_rad;
  double cos[6], sin[6];  // of the angles of the loop, a to f
};

struct Branch {
  JointVector joint_rad;  // each angle on the turn nearest to the previous joints
  double miss;  // 0: reached; otherwise the residual of an equation, in sines and shares of the reach
};

struct Branches {
  static constexpr int kMax = 28;  // eight, and double roots of the quartic
  int count = 0;
  std::array<Branch, kMax> branch;
};

/// x modulo whole turns, in [-π, π], for |x| < 1e6: adding the constant rounds to an integer.
inline double nearest_turn(double x) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi, kRound = 0x1.8p52;
  return x - kTwoPi * ((x / kTwoPi + kRound) - kRound);
}

class ClosedInverse {
 public:
  static constexpr double kFree = 2e-15;

  explicit ClosedInverse(const Kinematics& arm);

  [[nodiscard]] bool applies() const { return loop_.family != ArmFamily::kNone; }
  [[nodiscard]] const ArmLoop& loop() const { return loop_; }

  /// `X_WE` must be finite. `nearest`: of all branches that miss by at most ArmLoop::miss_max only the one nearest to
  /// `before` (minimum Σ Δq², each angle on the nearest turn). Others are skipped as soon as one angle alone
  /// is farther away: near known joints, all except their own branch.
  void solve(const Rigid& X_WE, const KnownJoints& before, Branches& out, bool nearest = false) const;

  /// `joint_rad` must be finite.
  [[nodiscard]] KnownJoints known(const JointVector& joint_rad) const;

 private:
  ArmLoop loop_;  // its lengths in shares of the reach
  double per_m_ = 1.0;
};

}  // namespace longreach
