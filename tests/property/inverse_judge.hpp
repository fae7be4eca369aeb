#pragma once
// Judges the inverse of an arm: every solution is exact, and none is missed.

#include <string>

#include "deploy/lab/robot/random_arm.hpp"

namespace longreach::test {

/// Exact kinematics against a pose that was itself rounded: a little above Refinement::kExact.
constexpr double kError = 1.2e-14;

struct Score {
  long poses = 0, solutions = 0, failed = 0;
  double worst = 0.0;  // rad, or share of the reach
};

/// The pose of `q`: each solution is one, one of them is `q` (regular) unless the pose leaves an angle free,
/// and the one that is asked for from `near` is the nearest of them (regular). The first failures are shown.
void judge(const NamedArm& arm, const Inverse& inverse, const JointVector& q, const JointVector& near,
           bool regular, Score& score);

/// Says the score, and expects that nothing failed.
void print(const std::string& name, const Score& score);

/// Moves joint `i` on to the nearest place where the determinant of the Jacobian changes its sign. False:
/// there is none.
bool make_singular(const Kinematics& kinematics, int i, JointVector& q);

/// 0 once in five, else 1e-3 to 1e-15 rad to either side.
double beside(Random& random);

}  // namespace longreach::test
