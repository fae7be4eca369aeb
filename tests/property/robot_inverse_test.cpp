// Joints -> pose -> joints: every reachable pose of the ready arms is solved exactly, also where the arm is
// singular or nearly so.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "deploy/lab/campaign_size.hpp"
#include "tests/property/inverse_judge.hpp"

namespace longreach::robot_inverse_test {
namespace {

using test::beside;
using test::exact_error;
using test::judge;
using test::kError;
using test::make_singular;
using test::random_joints;
using test::Score;

TEST(RobotInverse, FindsEveryPoseOfTheReadyArms) {
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.robot);
    Random random = Random(21).child(arm.name);
    Score score;
    for (int n = campaign(1'000'000, 3'000); n > 0; --n) {
      const JointVector q = random_joints(random);
      judge(arm, inverse, q, random_joints(random), true, score);
    }
    print(arm.name, score);
  }
}

// Through the joint limits of its file, from other joints within them.
TEST(RobotInverse, ReachesEveryPoseWithinTheLimitsOfTheReadyArms) {
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.limited);
    const double reach = inverse.kinematics().reach_m();
    Random random = Random(26).child(arm.name);
    double worst = 0.0;
    const int poses = campaign(1'000'000, 3'000);
    for (int n = 0; n < poses; ++n) {
      const JointVector q = random_joints(random, arm.limited);
      const Pose goal = inverse.kinematics().forward(q);
      const InverseResult result = inverse.solve(goal, random_joints(random, arm.limited), {});
      ASSERT_NE(result.status, InverseStatus::kNearest) << arm.name << " at " << q.transpose();
      for (std::size_t i = 0; i < kMaxJoints; ++i) {
        ASSERT_GE(result.joint_rad[static_cast<int>(i)], arm.limited.joint[i].min_rad);
        ASSERT_LE(result.joint_rad[static_cast<int>(i)], arm.limited.joint[i].max_rad);
      }
      worst = std::max(worst, exact_error(arm.limited, result.joint_rad, goal, reach));
      ASSERT_LE(worst, kError) << arm.name << " at " << q.transpose();
    }
    std::printf("%s within its limits: %d poses, error at most %.2g\n", arm.name.c_str(), poses, worst);
  }
}

TEST(RobotInverse, ReachesEveryPlaceOfTheCartesianRobot) {
  const Inverse inverse(test::cartesian());
  Random random(27);
  double worst_m = 0.0;
  const int poses = campaign(1'000'000, 3'000);
  for (int n = 0; n < poses; ++n) {
    JointVector q = random_joints(random, test::cartesian()), near = random_joints(random, test::cartesian());
    const InverseResult result = inverse.solve(inverse.kinematics().forward(q), near, {});
    ASSERT_EQ(result.status, InverseStatus::kFound) << q.transpose();
    worst_m = std::max(worst_m, (result.joint_rad - q).head<3>().cwiseAbs().maxCoeff());
  }
  std::printf("cartesian: %d places, joints off by at most %.2g m\n", poses, worst_m);
  EXPECT_LE(worst_m, 1e-14 * inverse.kinematics().reach_m());
}

TEST(RobotInverse, FindsEverySingularPoseOfTheReadyArms) {
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.robot);
    Random random = Random(22).child(arm.name);
    Score score;
    for (int n = campaign(300'000, 1'500); n > 0; --n) {
      JointVector q = random_joints(random);
      const int i = 1 + static_cast<int>(random.next() % 4);
      if (!make_singular(inverse.kinematics(), i, q)) continue;
      q[i] += beside(random);
      const JointVector near = n % 2 == 0 ? q : JointVector(q + random_joints(random, 0.3));
      judge(arm, inverse, q, near, false, score);
    }
    print(arm.name + ", singular", score);
  }
}

// The wrist of the space arm and of the UR10 turned into the direction of the three parallel axes, that of
// the PUMA straightened, elbows straight, wrists above the base: all at once and exactly.
TEST(RobotInverse, SolvesPosesThatAreSingularTwice) {
  constexpr double h = test::kHalfPi;
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.robot);
    Score score;
    for (const double wrist : {0.0, h, -h, 2.0 * h}) {
      for (const double elbow : {0.0, 2.0 * h, h, -h, 0.047012}) {
        for (const double shoulder : {0.0, h, -h, 0.3}) {
          JointVector q;
          q << 0.2, shoulder, elbow, 0.4, wrist, -0.3;
          judge(arm, inverse, q, q, false, score);
          judge(arm, inverse, q, JointVector::Zero(), false, score);
        }
      }
    }
    print(arm.name + ", singular twice", score);
  }
}

// Formed once, known joints lead to the nearest of all solutions of a pose, however far away: no farther than
// the joints that the pose was made from.
TEST(RobotInverse, FindsTheBranchOfKnownJoints) {
  std::vector<test::NamedArm> arms = test::ready_arms();
  Random random(28);
  for (const ArmFamily family : {ArmFamily::kSpherical, ArmFamily::kParallel}) {
    for (std::size_t first = 0; first < 4; ++first)
      arms.push_back({"random", test::random_arm(random, family, first)});
  }
  constexpr double kAside[] = {1e-12, 1e-6, 1e-3, 0.05, 0.09, 0.1, 0.2, 1.0, 3.0};
  const auto square = [](const JointVector& q, const JointVector& from) {
    return (q - from)
        .unaryExpr([](double x) { return std::remainder(x, 4.0 * test::kHalfPi); })
        .squaredNorm();
  };
  long poses = 0, beside_known = 0;
  for (const test::NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    const ClosedInverse& closed = inverse.closed();
    Branches one, all;
    for (int n = campaign(30'000, 300); n > 0; --n) {
      const JointVector from = random_joints(random);
      const KnownJoints known = closed.known(from);
      for (const double aside : kAside) {
        const JointVector q = from + random_joints(random, aside);
        const Rigid goal = inverse.kinematics().rigid_forward(q);
        closed.solve(goal, known, one, true);
        closed.solve(goal, closed.known(random_joints(random)), all);
        ASSERT_EQ(one.count, 1) << arm.name << " at " << q.transpose();
        const JointVector& found = one.branch[0].joint_rad;
        double least = square(q, from) + 1e-6, apart = 1.0;
        for (int i = 0; i < all.count; ++i) {
          const Branch& b = all.branch[static_cast<std::size_t>(i)];
          if (b.miss > closed.loop().miss_max) continue;
          least = std::min(least, square(b.joint_rad, from));
          apart = std::min(apart, test::apart(b.joint_rad, found));
        }
        ASSERT_LE(apart, 1e-14) << arm.name << " at " << q.transpose() << ", known at " << from.transpose();
        ASSERT_LE((found - from).squaredNorm(), least + 1e-13) << arm.name << " at " << q.transpose();
        ++poses;
        beside_known += test::apart(found, q) < 1e-6 ? 1 : 0;
      }
    }
  }
  std::printf("known joints: %ld poses, %ld in their branch\n", poses, beside_known);
}

}  // namespace
}  // namespace longreach::robot_inverse_test
