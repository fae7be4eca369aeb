#pragma once
// Checks the inverse of an arm: every solution is exact, and none is missing.

#include <string>

#include "deploy/lab/robot/random_arm.hpp"

namespace longreach::test {

/// Tolerance of exact kinematics for a pose that is itself rounded: slightly above Refinement::kExact.
constexpr double kError = 1.2e-14;

struct Score {
  long poses = 0, solutions = 0, failed = 0;
  double worst = 0.0;  // rad, or share of the reach
};

/// For the pose of `q`: each solution is exact, one of them is `q` (regular) unless the pose leaves an angle
/// free, and the solution requested from `near` is the nearest of them (regular). Prints the first failures.
void judge(const NamedArm& arm, const Inverse& inverse, const JointVector& q, const JointVector& near,
           bool regular, Score& score);

/// Prints the score, and expects no failure.
void print(const std::string& name, const Score& score);

/// Moves joint `i` to the nearest position at which the determinant of the Jacobian changes its sign. False:
/// there is none.
bool make_singular(const Kinematics& kinematics, int i, JointVector& q);

/// 0 once in five, else 1e-3 to 1e-15 rad to either side.
double beside(Random& random);

}  // namespace longreach::test
