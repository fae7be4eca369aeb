// From goal to joint setpoint as a whole: holding, limits, singular poses.

#include "slave/command/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/slave/space_arm.hpp"

namespace longreach::motion_test {
namespace {

constexpr double kDt = 1e-3;

double turned(const Pose& a, const Pose& b) { return log_rotation(a.q * b.q.conjugate()).norm(); }

TEST(Motion, HoldsTheOrientationWithoutCreepWhileThePositionMoves) {
  SlaveMotion motion({}, test::space_arm());
  const Pose start = motion.X_WE();
  for (int i = 0; i < 60000; ++i) {
    const double t = i * kDt;
    Pose goal = start;
    goal.p += Vector3(0.05 * std::sin(t), 0.05 * (1.0 - std::cos(0.7 * t)), 0.02 * std::sin(1.3 * t));
    motion.step({goal, {}, kDt});
    // The mean over a few ticks of joints that turn at this pace bends the way by less than this.
    ASSERT_LT(turned(motion.X_WE(), start), 1e-9) << t;
  }
  for (int i = 0; i < 3000; ++i) motion.step({start, {}, kDt});
  EXPECT_LT(turned(motion.X_WE(), start), 1e-13);
  EXPECT_LT((motion.X_WE().p - start.p).norm(), 1e-12);
  EXPECT_EQ(motion.limit_violations(), 0U);
}

TEST(Motion, HoldsThePositionWithoutCreepWhileTheOrientationMoves) {
  SlaveMotion motion({}, test::space_arm());
  const Pose start = motion.X_WE();
  for (int i = 0; i < 60000; ++i) {
    const double t = i * kDt;
    const Vector3 turn(0.1 * std::sin(t), 0.1 * (1.0 - std::cos(0.7 * t)), 0.05 * std::sin(1.3 * t));
    motion.step({Pose{start.p, exp_rotation(turn) * start.q}, {}, kDt});
    ASSERT_LT((motion.X_WE().p - start.p).norm(), 1e-6) << t;
  }
  for (int i = 0; i < 3000; ++i) motion.step({start, {}, kDt});
  EXPECT_LT(turned(motion.X_WE(), start), 1e-13);
  EXPECT_LT((motion.X_WE().p - start.p).norm(), 1e-12);
  EXPECT_EQ(motion.limit_violations(), 0U);
}

TEST(Motion, StandsStillOnAStillGoal) {
  SlaveMotion motion({}, test::space_arm());
  Pose goal = motion.X_WE();
  goal.p.x() += 0.1;
  for (int i = 0; i < 3000; ++i) motion.step({goal, {}, kDt});
  const JointVector stands = motion.joint_setpoint_rad();
  for (int i = 0; i < 10000; ++i) motion.step({goal, {}, kDt});
  EXPECT_EQ(motion.joint_setpoint_rad(), stands);
}

// Minutes of a goal beyond the wall of the workspace or beyond the arm leave nothing that has to be undone.
TEST(Motion, TurnsBackAtOnceHoweverLongTheGoalWasOutOfReach) {
  for (const double workspace_m : {1.0, 30.0}) {
    CommandConfig command;
    command.workspace_m = workspace_m;
    command.speed_max_m_per_s = 1.0;
    double back_s[2] = {0.0, 0.0};
    for (int n = 0; n < 2; ++n) {
      SlaveMotion motion(command, test::space_arm());
      const Pose start = motion.X_WE();
      Pose goal = start;
      goal.p.x() += 20.0;
      for (int i = 0; i < (n == 0 ? 20000 : 200000); ++i) motion.step({goal, {}, kDt});
      const double out = motion.X_WE().p.x();
      EXPECT_GT(out - start.p.x(), 0.9);
      int ticks = 0;
      for (; ticks < 10000 && motion.X_WE().p.x() > out - 0.05; ++ticks) motion.step({start, {}, kDt});
      back_s[n] = ticks * kDt;
    }
    EXPECT_LT(back_s[1], 1.0) << workspace_m;
    EXPECT_NEAR(back_s[0], back_s[1], 0.1) << workspace_m;
  }
}

TEST(Motion, SlowsDownTowardsASingularPoseAndNotOnTheWayOut) {
  CommandConfig command;
  command.workspace_m = 30.0;
  SlaveMotion motion(command, test::space_arm());
  const Pose start = motion.X_WE();
  Pose goal = start;
  goal.p.x() = 16.0;
  bool singular = false;
  for (int i = 0; i < 60000; ++i) singular = motion.step({goal, {}, kDt}).singularity || singular;
  EXPECT_TRUE(singular);
  const Vector3 stretched = motion.X_WE().p;
  for (int i = 0; i < 3000; ++i) motion.step({start, {}, kDt});
  EXPECT_GT((motion.X_WE().p - stretched).norm(), 0.4);  // of the 0.75 m of a free way
}

}  // namespace
}  // namespace longreach::motion_test
