// Joints -> pose -> joints: every reachable pose of every arm with a closed form is solved exactly, also
// where the arm is singular or nearly so.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "slave/robot/joint_step.hpp"
#include "tests/property/campaign.hpp"
#include "tests/property/random_arm.hpp"

namespace longreach {
namespace {

using test::apart;
using test::exact_error;
using test::random_joints;

// Exact kinematics against a pose that was itself rounded: a little above Inverse::kExact.
constexpr double kError = 1.2e-14;

struct Score {
  long poses = 0, solutions = 0;
  double worst = 0.0;
};

// All solutions at the pose of `q`: each is one, and one of them is `q` unless the pose leaves an angle free.
void expect_solved(const test::NamedArm& arm, const Inverse& inverse, const JointVector& q,
                   const JointVector& near, bool regular, Score& score) {
  const double reach = inverse.kinematics().reach_m();
  const Pose goal = inverse.kinematics().forward(q);
  const InverseSolutions all = inverse.all(goal, near, {});
  ASSERT_GT(all.count, 0) << arm.name << " at " << q.transpose();
  ASSERT_LE(all.count, regular ? 8 : InverseSolutions::kMax) << arm.name << " at " << q.transpose();
  double nearest = 10.0;
  for (int i = 0; i < all.count; ++i) {
    const JointVector& solution = all.joint_rad[static_cast<std::size_t>(i)];
    const double error = exact_error(arm.robot, solution, goal, reach);
    ASSERT_LE(error, kError) << arm.name << " at " << q.transpose() << " solution " << solution.transpose();
    score.worst = std::max(score.worst, error);
    nearest = std::min(nearest, apart(solution, q));
  }
  if (regular) {
    ASSERT_LE(nearest, 1e-4) << arm.name << " misses " << q.transpose();
  }
  ++score.poses;
  score.solutions += all.count;
}

void print(const std::string& name, const Score& score) {
  std::printf("%s: %ld poses, %.2f solutions each, error at most %.2g\n", name.c_str(), score.poses,
              static_cast<double>(score.solutions) / static_cast<double>(score.poses), score.worst);
}

// The nearest place along joint `i` from `q` where the determinant of the Jacobian changes its sign.
bool make_singular(const Kinematics& kinematics, int i, JointVector& q) {
  const auto determinant = [&](double x) {
    JointVector at = q;
    at[i] = x;
    Jacobian J = kinematics.rigid_with_jacobian(at).J;
    J.topRows<3>() *= kinematics.reach_m();
    return J.determinant();
  };
  constexpr double kStep = 0.05;
  double low = q[i], f_low = determinant(low);
  for (int n = 0; n < 130; ++n, low += kStep) {
    double high = low + kStep;
    const double f_high = determinant(high);
    if ((f_low < 0.0) != (f_high < 0.0)) {
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        ((determinant(middle) < 0.0) == (f_low < 0.0) ? low : high) = middle;
      }
      q[i] = low;
      return true;
    }
    f_low = f_high;
  }
  return false;
}

// 0, and 1e-3 to 1e-15 rad beside it, on either side.
double beside(Random& random) {
  const int exponent = static_cast<int>(random.next() % 16);
  if (exponent < 3) return 0.0;
  return (random.chance(0.5) ? 1.0 : -1.0) * std::pow(10.0, -exponent);
}

TEST(RobotInverse, FindsEveryPoseOfTheReadyArms) {
  for (const test::NamedArm& arm : test::ready_arms()) {
    const Inverse inverse(arm.robot);
    Random random = Random(21).child(arm.name);
    Score score;
    for (int n = campaign(1'000'000, 3'000); n > 0; --n) {
      const JointVector q = random_joints(random);
      ASSERT_NO_FATAL_FAILURE(expect_solved(arm, inverse, q, random_joints(random), true, score));
    }
    print(arm.name, score);
  }
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
      ASSERT_NO_FATAL_FAILURE(expect_solved(arm, inverse, q, near, false, score));
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
          ASSERT_NO_FATAL_FAILURE(expect_solved(arm, inverse, q, q, false, score));
          ASSERT_NO_FATAL_FAILURE(expect_solved(arm, inverse, q, JointVector::Zero(), false, score));
        }
      }
    }
    print(arm.name + ", singular twice", score);
  }
}

struct Family {
  ArmFamily family;
  std::size_t first;
};

class RandomArms : public testing::TestWithParam<Family> {};

TEST_P(RandomArms, AreSolvedEverywhere) {
  const auto [family, first] = GetParam();
  Random random = Random(23).child(std::to_string(static_cast<int>(family)) + std::to_string(first));
  Score score;
  for (int n = campaign(10'000, 60); n > 0; --n) {
    const test::NamedArm arm{"arm " + std::to_string(n), test::random_arm(random, family, first)};
    const Inverse inverse(arm.robot);
    ASSERT_TRUE(inverse.closed().applies()) << n;
    ASSERT_EQ(inverse.closed().loop().family, family);
    ASSERT_EQ(inverse.closed().loop().first_joint, static_cast<int>(first));
    for (int pose = 0; pose < 20; ++pose) {
      JointVector q = random_joints(random);
      const bool regular = pose < 14;
      const int i = 1 + pose % 4;
      if (!regular && make_singular(inverse.kinematics(), i, q)) q[i] += beside(random);
      ASSERT_NO_FATAL_FAILURE(expect_solved(arm, inverse, q, q + random_joints(random, 0.3), regular, score));
    }
  }
  print((family == ArmFamily::kSpherical ? "meeting from " : "parallel from ") + std::to_string(first + 1),
        score);
}

INSTANTIATE_TEST_SUITE_P(Families, RandomArms,
                         testing::Values(Family{ArmFamily::kSpherical, 0}, Family{ArmFamily::kSpherical, 1},
                                         Family{ArmFamily::kSpherical, 2}, Family{ArmFamily::kSpherical, 3},
                                         Family{ArmFamily::kParallel, 0}, Family{ArmFamily::kParallel, 1},
                                         Family{ArmFamily::kParallel, 2}, Family{ArmFamily::kParallel, 3}));

TEST(RobotInverse, SearchesForPosesOfAnyOtherArm) {
  Random random(24);
  const int arms = campaign(10'000, 300);
  int found = 0;
  double iterations = 0.0;
  for (int n = 0; n < arms; ++n) {
    const RobotConfig robot = test::random_arm(random);
    const Inverse inverse(robot);
    ASSERT_FALSE(inverse.closed().applies());
    const Pose goal = inverse.kinematics().forward(random_joints(random));
    const InverseResult result = inverse.solve(goal, random_joints(random), {1e-10, 30, 200});
    if (result.status == InverseStatus::kNearest) continue;
    ++found;
    iterations += result.iterations;
    ASSERT_LE(exact_error(robot, result.joint_rad, goal, inverse.kinematics().reach_m()), 2e-10) << n;
  }
  std::printf("any arm: %d of %d found, %.1f steps each\n", found, arms, iterations / found);
  EXPECT_GE(found, arms - (arms + 999) / 1000);
}

// One by one, from other solvers' point of view: as many solutions as an exhaustive search comes upon.
TEST(RobotInverse, CountsAsManySolutionsAsAnExhaustiveSearch) {
  Random random(25);
  const int poses = campaign(1'000, 12);
  std::vector<test::NamedArm> arms = test::ready_arms();
  for (std::size_t first = 0; first < 4; ++first) {
    arms.push_back(
        {"meeting " + std::to_string(first), test::random_arm(random, ArmFamily::kSpherical, first)});
    arms.push_back(
        {"parallel " + std::to_string(first), test::random_arm(random, ArmFamily::kParallel, first)});
  }
  for (int n = 0; n < poses; ++n) {
    const test::NamedArm& arm = arms[static_cast<std::size_t>(n) % arms.size()];
    const Inverse inverse(arm.robot);
    const NumericInverse numeric(arm.robot);
    const JointVector q = random_joints(random);
    const Rigid goal = inverse.kinematics().rigid_forward(q);
    if (conditioning(inverse.kinematics().rigid_with_jacobian(q).J, inverse.kinematics().reach_m()) < 0.01)
      continue;
    const InverseSolutions all = inverse.all(to_pose(goal), q, {});
    std::vector<JointVector> seen;
    for (int start = 0; start < 3'000; ++start) {
      const NumericResult run = numeric.search_once(goal, random_joints(random), {1e-9, 40, 0});
      if (!run.found) continue;
      const auto same = [&](const JointVector& other) { return apart(run.joint_rad, other) < 1e-4; };
      if (std::none_of(seen.begin(), seen.end(), same)) seen.push_back(run.joint_rad);
    }
    EXPECT_EQ(static_cast<std::size_t>(all.count), seen.size()) << arm.name << " at " << q.transpose();
  }
}

}  // namespace
}  // namespace longreach
