#pragma once
// Recognizes from its Denavit-Hartenberg rows whether a six-joint arm has a closed-form inverse, and orders
// the joints as the closed form solves them (Pieper 1968; Raghavan, Roth 1990 for the loop).
//
// With a given tool pose, an arm is a closed loop  Rz(φ_a) L_a Rz(φ_b) L_b ... Rz(φ_f) L_f = 1  with six
// constant links. The loop may start at any joint and run in either direction. It is arranged so that the
// three special axes come last, d e f:
//   spherical: they intersect in one point (the origin of d, e, f):  L_d = Rx(α_d), L_e = Rx(α_e)
//   parallel:  L_d = Tx(a_d), L_e = Tx(a_e)
// In addition, L_a = Tx(a) Rx(α) must not contain the pose. If several orders are possible, one with a = 0 or
// sin α = 0 is preferred, because the equations of the position are then quadratic; otherwise, one of them is
// of fourth degree.
//
// A row counts as special if it deviates from the above form by at most kRowTolerance, in rad and in
// multiples of Kinematics::motion_length_m. The caller corrects the deviation with the exact kinematics. If
// no row is special within that tolerance, for example on a calibrated arm, kNearTolerance is used instead,
// and the loop is marked `nearly`.

#include <array>
#include <string_view>

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

constexpr double kRowTolerance = 1e-6;
constexpr double kNearTolerance = 5e-3;

enum class ArmFamily : std::uint8_t { kNone, kSpherical, kParallel };

/// A joint of the loop: q = sign φ - theta.
struct LoopJoint {
  int joint = 0;
  double sign = 1.0, theta_rad = 0.0;
};

struct ArmLoop {
  enum Role : std::size_t { kA, kB, kC, kD, kE, kF };

  ArmFamily family = ArmFamily::kNone;
  int first_joint = 0;      // first of the three special joints, from 0
  bool triangular = false;  // true: a = 0 or sin α = 0, so the equations are quadratic
  std::array<LoopJoint, 6> joint{};
  double a_m = 0.0, sin_alpha = 0.0, cos_alpha = 1.0;  // L_a; values within the tolerance of 0 are set to 0
  std::array<Rigid, 6> link{};                         // L_b, L_c, L_f; the link with the pose is empty
  /// The link that contains the pose is `before` X_WE^-1 `behind`, or `before` X_WE `behind` if the loop runs
  /// backwards.
  std::size_t pose_role = kF;
  Rigid before{}, behind{};
  bool backwards = false;
  bool straight = false;  // neither `before` nor `behind` rotates
  bool nearly = false;    // solutions of the loop are only close to those of the arm
  /// Maximum miss of a branch (closed_inverse.hpp) that has a solution of the arm near it.
  double miss_max = 1e-6;
  // Spherical: sine and cosine of α_d and α_e. Parallel: a_d and a_e in m (the cosines are not used).
  double first = 0.0, first_cos = 0.0, second = 0.0, second_cos = 0.0;
};

/// Returns the loop of an arm; its family is kNone if no closed form applies or a joint is not revolute.
ArmLoop recognise(const Kinematics& arm);

/// Returns the link that contains the pose. The lengths of `loop` are in multiples of the reach, 1 / `per_m`.
inline Rigid pose_link(const ArmLoop& loop, const Rigid& X_WE, double per_m) {
  const Vector3 p = per_m * X_WE.p;
  Rigid X;
  if (loop.backwards) {
    X.R = X_WE.R;
    X.p.noalias() = p + X.R * loop.behind.p;
  } else {
    X.R = X_WE.R.transpose();
    X.p.noalias() = X.R * (loop.behind.p - p);
  }
  if (!loop.straight) X = {loop.before.R * X.R * loop.behind.R, loop.before.R * X.p};
  X.p += loop.before.p;
  return X;
}

/// Returns a description such as "spherical wrist (axes 4-5-6 meet), quadratic". The text has static
/// lifetime.
std::string_view words(const ArmLoop& loop);

}  // namespace longreach
