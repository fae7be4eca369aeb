#pragma once
// Recognises the closed form of a six-joint arm from its Denavit-Hartenberg rows, and orders the joints as
// that form solves them (Pieper 1968; Raghavan, Roth 1990 for the loop).
//
// With the pose of the tool given, an arm is a closed loop  Rz(φ_a) L_a Rz(φ_b) L_b ... Rz(φ_f) L_f = 1  of
// six constant links, and a loop may begin at any joint and run either way. It is turned so that the three
// special axes come last, d e f:
//   spherical: they intersect in one point (the origin of d, e, f):  L_d = Rx(α_d), L_e = Rx(α_e)
//   parallel:  L_d = Tx(a_d), L_e = Tx(a_e)
// and so that L_a = Tx(a) Rx(α) does not contain the pose. Of several such orders one with a = 0 or sin α = 0
// is preferred: the position then leads to quadratic equations, otherwise to one of fourth degree.
//
// Rows count as special within kRowTolerance: rad, and share of Kinematics::motion_length_m. The caller
// corrects deviations within the tolerance with the exact kinematics. If no row is special, rows within kNearTolerance
// are, as those of a calibrated arm; the loop is then marked `nearly`.

#include <array>
#include <string_view>

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

constexpr double kRowTolerance = 1e-6;
constexpr double kNearTolerance = 5e-3;

enum class ArmFamily : std::uint8_t { kNone, kSpherical, kParallel };

/// One of the joints in the loop: q = sign φ - theta.
struct LoopJoint {
  int joint = 0;
  double sign = 1.0, theta_rad = 0.0;
};

struct ArmLoop {
  enum Role : std::size_t { kA, kB, kC, kD, kE, kF };

  ArmFamily family = ArmFamily::kNone;
  int first_joint = 0;      // of the three special joints, from 0
  bool triangular = false;  // a = 0 or sin α = 0
  std::array<LoopJoint, 6> joint{};
  double a_m = 0.0, sin_alpha = 0.0, cos_alpha = 1.0;  // L_a; values within tolerance of 0 are 0
  std::array<Rigid, 6> link{};                         // L_b, L_c, L_f; the one with the pose is empty
  std::size_t pose_role = kF;                          // which of them contains the pose, as
  Rigid before{}, behind{};  // `before` X_WE^-1 `behind`, or with X_WE in a loop that runs backwards
  bool backwards = false;
  bool straight = false;   // neither of them rotates
  bool nearly = false;     // the solutions are near those of the arm
  double miss_max = 1e-6;  // a branch with a larger miss has no solution near it
  // Spherical: sin and cos of α_d, α_e. Parallel: a_d, a_e in m (cos unused).
  double first = 0.0, first_cos = 0.0, second = 0.0, second_cos = 0.0;
};

/// kNone if no closed form applies, or a joint is not revolute.
ArmLoop recognise(const Kinematics& arm);

/// The link that contains the pose; lengths of `loop` in shares of the reach, 1 / `per_m`.
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

/// "spherical wrist (axes 4-5-6 meet), quadratic", "three parallel axes (2-3-4), fourth degree", ... The text
/// has static lifetime.
std::string_view words(const ArmLoop& loop);

}  // namespace longreach
