#pragma once
// Checks the inverse kinematics of an arm: every solution must be exact, and none may be missing.

#include <string>

#include "deploy/lab/robot/random_arm.hpp"

namespace longreach::test {

/// Tolerance for exact solutions of a pose that is itself rounded, slightly above Refinement::kExact.
constexpr double kError = 1.2e-14;

struct Score {
  long poses = 0, solutions = 0, failed = 0;
  double worst = 0.0;  // largest error, in rad or as a fraction of the reach
};

/// Checks the solutions for the pose of `q`. Each solution must be exact. If `regular`, one of them must be
/// `q` (unless the pose leaves an angle free), and the solution requested for `near` must be the one nearest
/// to `near`. Prints the first failures.
void judge(const NamedArm& arm, const Inverse& inverse, const JointVector& q, const JointVector& near,
           bool regular, Score& score);

/// Prints the score and expects no failures.
void print(const std::string& name, const Score& score);

/// Increases joint `i` in `q` to the next position at which the determinant of the Jacobian changes sign.
/// Returns false if there is none.
bool make_singular(const Kinematics& kinematics, int i, JointVector& q);

/// Returns a random offset: 0 in one out of five cases, otherwise 1e-15 to 1e-3 rad with either sign.
double beside(Random& random);

}  // namespace longreach::test
