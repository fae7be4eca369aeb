#pragma once
// All joint angles for a tool pose in closed form, for arms whose loop arm_loop.hpp recognizes.
//
// The loop leads to two equations in an angle c and a further angle β:
//   a X = x(c),  sin α Y = y(c),  (X, Y) = Rot(β) r(c)          x, y, r: k + k' cos c + k'' sin c
// (spherical: X and Y belong to the intersection point of the axes, seen from the axes a and b, β = φ_b;
// parallel: to the common direction of the axes, β = -φ_a). With a = 0 or sin α = 0, one equation contains
// only c: it has two roots by the phase formula, and each gives two values of β. Otherwise X² + Y² = r² is a
// trigonometric polynomial of second degree in c with up to four roots. The remaining joints form a wrist or
// a planar arm, each with two solutions, so there are at most eight solutions in total.
//
// Angles are computed as the direction of a vector, lengths with hypot, and differences of squares as
// products; acos is not used. Where such a vector vanishes (length below kFree), the pose does not determine
// the angle, so the angle of the previous joints is kept. Where the discriminant of a root is negative, the
// nearest real root is used, and `miss` gives the deviation. Near a singular pose, a square root halves the
// number of correct digits of an angle; the caller improves the result by Newton steps (inverse.hpp). Joint
// limits are not considered.

#include <array>
#include <numbers>

#include "slave/kinematics/arm_loop.hpp"
#include "slave/kinematics/quartic_turns.hpp"

namespace longreach {

/// The current joints, which determine the branch. Their sines and cosines are computed once for all poses
/// near them. The angles of solutions near them need no arc tangent.
struct KnownJoints {
  JointVector joint_rad;
  double cos[6], sin[6];  // cosines and sines of the loop angles, a to f
};

struct Branch {
  JointVector joint_rad;  // each angle shifted by full turns to be nearest to the previous angle
  /// 0: the pose is reached; otherwise the residual of an equation, as a sine or in multiples of the reach.
  double miss;
};

struct Branches {
  static constexpr int kMax = 28;  // eight solutions, plus double roots of the quartic
  int count = 0;
  std::array<Branch, kMax> branch;
};

/// Returns x modulo full turns, in [-π, π], for |x| < 1e6. Adding and subtracting kRound rounds to an integer.
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

  /// `X_WE` must be finite. If `nearest`, returns only the branch nearest to `before` (minimum Σ Δq², each
  /// angle shifted by full turns) among those that miss by at most ArmLoop::miss_max. A branch is skipped as
  /// soon as one of its angles alone is farther away than the best result; near known joints, all branches
  /// except the current one are skipped.
  void solve(const Rigid& X_WE, const KnownJoints& before, Branches& out, bool nearest = false) const;

  /// Prepares the given joint angles for solve(); `joint_rad` must be finite.
  [[nodiscard]] KnownJoints known(const JointVector& joint_rad) const;

 private:
  ArmLoop loop_;  // the loop, with lengths in multiples of the reach
  double per_m_ = 1.0;
};

}  // namespace longreach
