#include "slave/kinematics/inverse.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "slave/kinematics/joint_step.hpp"
#include "tests/support/allocations.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::inverse_test {
namespace {

using test::kPi;

RobotConfig ur10() {
  RobotConfig robot;
  const double a[] = {0, -0.612, -0.5723, 0, 0, 0}, d[] = {0.1273, 0, 0, 0.163941, 0.1157, 0.0922};
  const double alpha[] = {kPi / 2, 0, 0, kPi / 2, -kPi / 2, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    robot.joint[i].a_m = a[i], robot.joint[i].d_m = d[i], robot.joint[i].alpha_rad = alpha[i];
    robot.joint[i].min_rad = -2.0 * kPi, robot.joint[i].max_rad = 2.0 * kPi;
  }
  return robot;
}

// Slides along z, y and x of W; no wrist.
RobotConfig cartesian() {
  RobotConfig robot;
  for (JointConfig& j : robot.joint) j.kind = JointKind::kFixed;
  for (std::size_t i = 0; i < 3; ++i) {
    robot.joint[i].kind = JointKind::kPrismatic;
    robot.joint[i].min_rad = -1.0, robot.joint[i].max_rad = 1.0;
  }
  robot.joint[0].alpha_rad = -kPi / 2;
  robot.joint[1].alpha_rad = robot.joint[1].theta_rad = kPi / 2;
  return robot;
}

JointVector ordinary() {
  JointVector q;
  q << 0.3, -1.2, 1.6, -2.0, -1.4, 0.5;
  return q;
}

TEST(Inverse, SaysWhichClosedFormApplies) {
  EXPECT_EQ(Inverse(test::space_arm()).words(), "closed form, quadratic: axes 2-3-4 parallel");
  EXPECT_EQ(Inverse(ur10()).words(), "closed form, quadratic: axes 2-3-4 parallel");
  EXPECT_EQ(Inverse(cartesian()).words(), "linear: three prismatic joints, rotation ignored");
  RobotConfig bent = ur10();
  bent.joint[1].alpha_rad = 0.1;
  EXPECT_EQ(Inverse(bent).words(), "no closed form: solved numerically");
}

TEST(Inverse, TakesTheBranchOfTheMeasuredJoints) {
  const Inverse inverse(ur10());
  const JointVector q = ordinary();
  const InverseSolutions all = inverse.all(inverse.kinematics().forward(q), q, {});
  ASSERT_EQ(all.count, 8);
  for (int i = 0; i < all.count; ++i) {
    const JointVector& branch = all.joint_rad[static_cast<std::size_t>(i)];
    const InverseResult result = inverse.solve(inverse.kinematics().forward(q), branch, {});
    EXPECT_EQ(result.status, InverseStatus::kFound);
    EXPECT_LT((result.joint_rad - branch).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// A wrist singularity has solutions without end; which of them the closed form gives depends on rounding,
// which grows with the height of the base.
TEST(Inverse, StaysAtASolutionBesideASingularPose) {
  for (const double height_m : {0.0, 0.13, 1.0, 4.0, 30.0}) {
    for (const double wrist : {0.0, kPi, -kPi}) {
      for (const double off_rad : {0.0, 1e-9}) {
        RobotConfig robot = ur10();
        robot.joint[0].d_m = height_m;
        const Inverse inverse(robot);
        JointVector q;
        q << 1.0, -2.0, 2.0, -1.0, wrist, 0.0;
        const Pose goal = inverse.kinematics().forward(q);
        const JointVector near = q + JointVector::Constant(off_rad);
        const InverseResult result = inverse.solve(goal, near, {1e-12, 100, 200});
        EXPECT_EQ(result.status, InverseStatus::kSingular);
        EXPECT_LT((result.joint_rad - q).cwiseAbs().maxCoeff(), 1e-7) << height_m << " m, " << wrist;
      }
    }
  }
}

TEST(Inverse, ShiftsAnAngleByATurnToStayWithinTheLimits) {
  RobotConfig robot = ur10();
  const JointVector q = ordinary();
  const Pose goal = Inverse(robot).kinematics().forward(q);
  robot.joint[5].min_rad = 5.0;  // 0.5 only as 0.5 + 2π
  robot.joint[5].max_rad = 7.0;
  const InverseResult result = Inverse(robot).solve(goal, q, {});
  EXPECT_EQ(result.status, InverseStatus::kFound);
  EXPECT_NEAR(result.joint_rad[5], 0.5 + 2.0 * kPi, 1e-12);
}

TEST(Inverse, NeverAnswersBeyondAJointLimit) {
  RobotConfig robot = ur10();
  for (JointConfig& j : robot.joint) j.min_rad = -0.4, j.max_rad = 0.4;
  const Inverse inverse(robot);
  const InverseResult result =
      inverse.solve(inverse.kinematics().forward(ordinary()), JointVector::Zero(), {});
  EXPECT_EQ(result.status, InverseStatus::kNearest);
  EXPECT_GT(result.position_error_m + result.rotation_error_rad, 0.01);
  EXPECT_LE(result.joint_rad.cwiseAbs().maxCoeff(), 0.4);
}

TEST(Inverse, PrefersWhatItIsToldTo) {
  RobotConfig robot = ur10();
  const JointVector q = ordinary();
  const Pose goal = Inverse(robot).kinematics().forward(q);
  robot.prefer = BranchPreference::kCentred;
  const InverseResult centred = Inverse(robot).solve(goal, q, {});
  EXPECT_EQ(centred.status, InverseStatus::kFound);
  const InverseSolutions all = Inverse(robot).all(goal, q, {});
  for (int i = 0; i < all.count; ++i) {
    EXPECT_LE(centred.joint_rad.cwiseAbs().maxCoeff(),
              all.joint_rad[static_cast<std::size_t>(i)].cwiseAbs().maxCoeff() + 1e-9);
  }
  // A slow wrist: the branch that moves it least is there soonest.
  robot.prefer = BranchPreference::kSoonest;
  robot.joint[5].speed_max_rad_per_s = 1e-4;
  JointVector near = q;
  near[0] += 1.0;
  EXPECT_NEAR(Inverse(robot).solve(goal, near, {}).joint_rad[5], q[5], 1e-9);
}

TEST(Inverse, AnswersOutOfReachWithTheDistance) {
  const Inverse inverse(test::space_arm());
  Pose goal = inverse.kinematics().forward(test::start_joints());
  goal.p = {0.0, 20.0, 0.0};
  const InverseResult result = inverse.solve(goal, test::start_joints(), {1e-10, 100, 10});
  EXPECT_EQ(result.status, InverseStatus::kNearest);
  EXPECT_GE(result.position_error_m, 20.0 - 15.32);
  EXPECT_NEAR((inverse.kinematics().forward(result.joint_rad).p - goal.p).norm(), result.position_error_m,
              1e-12);
}

TEST(Inverse, NamesTheDirectionThatASingularPoseLoses) {
  RobotConfig robot = test::space_arm();
  for (JointConfig& j : robot.joint) j.min_rad = -4, j.max_rad = 4;
  const Inverse inverse(robot);
  JointVector q = test::start_joints();
  q[2] = 0.0;  // the elbow straight
  const InverseResult result = inverse.solve(inverse.kinematics().forward(q), q, {});
  EXPECT_EQ(result.status, InverseStatus::kSingular);
  EXPECT_NEAR(result.lost.norm(), 1.0, 1e-12);
  Jacobian J = inverse.kinematics().rigid_with_jacobian(result.joint_rad).J;
  J.topRows<3>() *= inverse.kinematics().motion_length_m();
  EXPECT_LT((J.transpose() * result.lost).norm(), 1e-6 * inverse.kinematics().motion_length_m());
}

// The wrist stands above the base, which may turn, but not so far that the almost straight arm falls short.
TEST(Inverse, TurnsAnOpenJointAsFarAsTheArmNeeds) {
  RobotConfig robot = test::space_arm();
  for (JointConfig& j : robot.joint) j.min_rad = -7, j.max_rad = 7;
  const Inverse inverse(robot);
  JointVector q;
  q << 1.9274818256738837, 1.6074215481170673, -0.066365460489758582, -0.021764130200958576,
      -0.66796994300958534, -0.8409758685465883;
  JointVector near = q;
  near[0] = 1.69;
  const InverseResult result = inverse.solve(inverse.kinematics().forward(q), near, {});
  EXPECT_EQ(result.status, InverseStatus::kSingular);
  EXPECT_LE(result.position_error_m, 1e-13);
  EXPECT_GT(result.joint_rad[0], 1.70);
  EXPECT_LT(result.joint_rad[0], q[0] + 1e-9);
}

TEST(Inverse, MovesTheCartesianRobotExactlyAndSaysThatItDoesNotTurn) {
  const Inverse inverse(cartesian());
  Pose goal;
  goal.p = {0.1, -0.2, 0.3};
  const InverseResult result = inverse.solve(goal, JointVector::Zero(), {});
  EXPECT_EQ(result.status, InverseStatus::kFound);
  EXPECT_TRUE(result.rotation_ignored);
  EXPECT_GT(result.rotation_error_rad, 1.0);
  EXPECT_LT((result.joint_rad.head<3>() - Vector3(0.3, -0.2, 0.1)).norm(), 1e-15);
  EXPECT_EQ(result.joint_rad.tail<3>(), Vector3::Zero());
  goal.p.x() = 1.5;
  const InverseResult beyond = inverse.solve(goal, JointVector::Zero(), {});
  EXPECT_EQ(beyond.status, InverseStatus::kNearest);
  EXPECT_TRUE(beyond.at_joint_limit);
  EXPECT_NEAR(beyond.position_error_m, 0.5, 1e-14);
}

TEST(Inverse, DoesNotJumpToAnotherBranchWhenItFollows) {
  const Inverse inverse(ur10());
  const JointVector q = ordinary();
  JointVector flipped = q;
  for (int i = 0; i < 6; ++i) flipped[i] += i == 2 ? -3.0 : 0.8;
  const InverseResult result = inverse.follow(inverse.kinematics().forward(flipped), q, {1e-10, 1, 0});
  EXPECT_LE((result.joint_rad - q).cwiseAbs().maxCoeff(), 0.3 + 1e-12);
  JointVector close = q;
  close[3] += 0.01;
  EXPECT_LT((inverse.follow(inverse.kinematics().forward(close), q, {}).joint_rad - close).norm(), 1e-12);
}

TEST(Inverse, SurvivesExtremes) {
  const Inverse inverse(ur10());
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double x :
       {0.0, 1e-9, 1e9, 1e300, 5e-324, kInf, -kInf, std::numeric_limits<double>::quiet_NaN()}) {
    Pose goal = inverse.kinematics().forward(ordinary());
    goal.p.x() = x;
    const InverseResult result = inverse.solve(goal, ordinary(), {});
    EXPECT_TRUE(result.joint_rad.allFinite()) << x;
    EXPECT_TRUE(inverse.follow(goal, ordinary(), {}).joint_rad.allFinite()) << x;
    if (!(std::abs(x) < 1e6)) {
      EXPECT_EQ(result.status, InverseStatus::kNearest) << x;
    }
  }
}

TEST(Inverse, DoesNotAllocate) {
  const Inverse inverse(ur10());
  JointVector singular = ordinary();
  singular[4] = 0.0;
  const Pose near = inverse.kinematics().forward(singular);
  Pose far = near;
  far.p.x() = 9.0;
  test::count_allocations(true);
  const InverseResult a = inverse.solve(near, ordinary(), {}),
                      b = inverse.solve(far, ordinary(), {1e-10, 20, 5});
  const int solutions = inverse.all(near, ordinary(), {}).count;
  const InverseResult c = inverse.follow(near, singular, {});
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
  EXPECT_GT(solutions, 0);
  EXPECT_NE(c.status, InverseStatus::kNearest);
  EXPECT_NE(a.status, InverseStatus::kNearest);
  EXPECT_EQ(b.status, InverseStatus::kNearest);
}

}  // namespace
}  // namespace longreach::inverse_test
