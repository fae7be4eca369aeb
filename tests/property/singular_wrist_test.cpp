// Straight through exactly singular wrists: the inverse continues from the joints, without a jump.

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "deploy/lab/robot/random_arm.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach::singular_wrist_test {
namespace {

constexpr int kWristBend = 4;  // singular at zero

struct Counted {
  int leaps = 0, missed = 0;
};

/// A path in joint space that passes joint 5 through zero, in 200 steps of which one is exactly there. A leap:
/// joints move more than five times as far as on the path in a step, and thrice as far as in the step before.
Counted through(const Inverse& inverse, const JointVector& middle, const JointVector& along) {
  constexpr int kSteps = 100;
  Counted counted;
  JointVector before = middle - along;
  const double step = along.cwiseAbs().maxCoeff() / kSteps;
  double last = step;
  for (int n = -kSteps; n <= kSteps; ++n) {
    const JointVector q = middle + (static_cast<double>(n) / kSteps) * along;
    const InverseResult result = inverse.solve(inverse.kinematics().forward(q), before, {});
    counted.missed += result.status == InverseStatus::kNearest;
    const double moved = (result.joint_rad - before).cwiseAbs().maxCoeff();
    counted.leaps += moved > 5.0 * step && moved > 3.0 * last;
    last = moved;
    before = result.joint_rad;
  }
  return counted;
}

TEST(SingularWrist, IsPassedWithoutALeap) {
  constexpr int kPaths = 1000;
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.robot);
    Random random(5);
    int leaps = 0, missed = 0;
    for (int path = 0; path < kPaths; ++path) {
      JointVector middle = test::random_joints(random), along;
      middle[kWristBend] = 0.0;
      for (double& x : along) x = 0.4 * (random.uniform() - 0.5);
      along[kWristBend] = random.uniform() < 0.5 ? -0.3 : 0.3;
      const Counted counted = through(inverse, middle, along);
      leaps += counted.leaps > 0;
      missed += counted.missed > 0;
    }
    EXPECT_EQ(leaps, 0) << arm.name;
    EXPECT_EQ(missed, 0) << arm.name;
  }
}

}  // namespace
}  // namespace longreach::singular_wrist_test
