// Arms at random: those of a family with a closed form are solved everywhere, all others almost everywhere,
// and an exhaustive search comes upon the same number of solutions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "deploy/lab/campaign_size.hpp"
#include "slave/kinematics/joint_step.hpp"
#include "tests/property/inverse_judge.hpp"

namespace longreach::random_arms_test {
namespace {

using test::apart;
using test::beside;
using test::exact_error;
using test::judge;
using test::make_singular;
using test::random_joints;
using test::Score;

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
      judge(arm, inverse, q, q + random_joints(random, 0.3), regular, score);
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

TEST(AnyArm, SearchesForPosesOfAnyOtherArm) {
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

// Parallel axes that all but coincide make an arm that is all but singular everywhere.
TEST(AnyArm, SolvesArmsWhoseParallelAxesAllButCoincide) {
  Random random(28);
  Score score;
  for (int n = campaign(8'000, 80); n > 0; --n) {
    const auto first = static_cast<std::size_t>(n % 4);
    test::NamedArm arm{"arm " + std::to_string(n), test::random_arm(random, ArmFamily::kParallel, first)};
    arm.robot.joint[first + (random.chance(0.5) ? 1 : 0)].a_m = std::pow(10.0, random.uniform(-6.0, -3.0));
    const Inverse inverse(arm.robot);
    ASSERT_TRUE(inverse.closed().applies()) << n;
    for (int pose = 0; pose < 20; ++pose) {
      const JointVector q = random_joints(random);
      judge(arm, inverse, q, q + random_joints(random, 0.3), false, score);
    }
  }
  print("parallel, two axes almost one", score);
}

// From other starts than the closed form knows of: at least kStarts runs of the search, and more as long as
// it has come upon fewer solutions.
std::size_t searched(const NumericInverse& numeric, const Rigid& goal, std::size_t expected, Random& random) {
  constexpr int kStarts = 1'000, kStartsMax = 100'000;
  std::vector<JointVector> seen;
  for (int start = 0; start < kStarts || (seen.size() < expected && start < kStartsMax); ++start) {
    const NumericResult run = numeric.search_once(goal, random_joints(random), {1e-9, 40, 0});
    if (!run.found) continue;
    const auto same = [&](const JointVector& other) { return apart(run.joint_rad, other) < 1e-4; };
    if (std::none_of(seen.begin(), seen.end(), same)) seen.push_back(run.joint_rad);
  }
  return seen.size();
}

TEST(AnyArm, CountsAsManySolutionsAsAnExhaustiveSearch) {
  Random random(25);
  std::vector<test::NamedArm> arms = test::ready_arms();
  for (std::size_t first = 0; first < 4; ++first) {
    arms.push_back(
        {"meeting " + std::to_string(first), test::random_arm(random, ArmFamily::kSpherical, first)});
    arms.push_back(
        {"parallel " + std::to_string(first), test::random_arm(random, ArmFamily::kParallel, first)});
  }
  for (const test::NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    const NumericInverse numeric(arm.robot);
    int poses = campaign(1'000, 2), skipped = 0;
    std::size_t solutions = 0;
    for (int n = 0; n < poses;) {
      const JointVector q = random_joints(random);
      const Rigid goal = inverse.kinematics().rigid_forward(q);
      const InverseSolutions all = inverse.all(to_pose(goal), q, {});
      // Where two solutions are about to meet a search cannot tell them apart.
      const bool regular =
          std::all_of(all.joint_rad.begin(), all.joint_rad.begin() + all.count, [&](const JointVector& x) {
            return conditioning(inverse.kinematics().rigid_with_jacobian(x).J,
                                inverse.kinematics().reach_m()) > 1e-3;
          });
      if (!regular && ++skipped > 0) continue;
      const auto count = static_cast<std::size_t>(all.count);
      EXPECT_EQ(count, searched(numeric, goal, count, random)) << arm.name << " at " << q.transpose();
      solutions += count, ++n;
    }
    std::printf("%s: %d poses, %zu solutions, as many as were searched; left out as nearly singular: %d\n",
                arm.name.c_str(), poses, solutions, skipped);
  }
}

}  // namespace
}  // namespace longreach::random_arms_test
