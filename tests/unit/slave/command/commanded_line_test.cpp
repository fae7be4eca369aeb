// A robot at the ends of its reach: the tool stops on its line, and each of the two lines ends by itself.
#include "slave/command/commanded_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "slave/command/motion.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::commanded_line_test {
namespace {

constexpr double kDt = 1e-3;

CommandConfig wide() {
  CommandConfig command;
  command.workspace_m = 40.0;
  return command;
}

struct Driven {
  Vector3 moved_m = Vector3::Zero(), turned_rad = Vector3::Zero();
  Clamps clamps{};
  std::uint64_t violations = 0;
};

/// The goal moves away from the start pose at this velocity, at most this far, and stays there.
Driven drive(SlaveMotion& motion, const Twist& velocity, double moves_s, double lasts_s) {
  const Pose from = motion.X_WE();
  Driven out;
  for (double t = 0.0; t < lasts_s; t += kDt) {
    const double moved_s = std::min(t, moves_s);
    out.clamps = motion.step(
        {Pose{from.p + moved_s * velocity.linear, exp_rotation(moved_s * velocity.angular) * from.q},
         {},
         kDt});
  }
  out.moved_m = motion.X_WE().p - from.p;
  out.turned_rad = log_rotation(motion.X_WE().q * from.q.conjugate());
  out.violations = motion.limit_violations();
  return out;
}

TEST(CommandedLine, EndsBeforeTheEndOfTheReach) {
  const RobotConfig robot = test::space_arm();
  for (const Vector3& along : {Vector3(1, 0, 0), Vector3(0.8, 0.6, 0), Vector3(0.6, 0, 0.8)}) {
    SlaveMotion motion(wide(), robot);
    const Inverse inverse(robot);
    const Pose from = motion.X_WE();
    const Driven out = drive(motion, {Vector3::Zero(), 0.15 * along}, 80.0, 85.0);
    const double way_m = along.dot(out.moved_m);
    EXPECT_LE((out.moved_m - way_m * along).norm(), 2e-3);
    EXPECT_LE(out.turned_rad.norm(), 10e-3);
    EXPECT_EQ(out.violations, 0u);
    EXPECT_TRUE(out.clamps.unreachable || out.clamps.joint != 0);
    const ReachEnd end = inverse.reach_end({from.p + (way_m + 3e-3) * along, from.q},
                                           motion.joint_setpoint_rad(), {1e-10, 20, 0});
    EXPECT_TRUE(end.ends) << "it stands more than 3 mm before the end";
  }
}

// The first joint of the space arm turns to 3.1 rad; the tool turns with it about its own place.
TEST(CommandedLine, OfTheRotationEndsAtAJointLimitWhileTheTranslationGoesOn) {
  RobotConfig robot = test::space_arm();
  robot.joint[5].max_rad = 0.1;
  SlaveMotion motion(wide(), robot);
  const Vector3 axis =
      motion.kinematics().rigid_with_jacobian(motion.joint_setpoint_rad()).J.col(5).head<3>();
  const Driven out = drive(motion, {0.2 * axis, Vector3(-0.05, 0, 0)}, 3.0, 6.0);
  EXPECT_NEAR(axis.dot(out.turned_rad), 0.1, 5e-3);
  EXPECT_LE(axis.dot(out.turned_rad), 0.1);
  EXPECT_NEAR(out.moved_m.x(), -0.15, 1e-3);
  EXPECT_EQ(out.clamps.joint, 6);
  EXPECT_EQ(out.violations, 0u);
}

TEST(CommandedLine, IsLeftAtOnceInward) {
  SlaveMotion motion(wide(), test::space_arm());
  const Pose from = motion.X_WE();
  drive(motion, {Vector3::Zero(), Vector3(0.15, 0, 0)}, 80.0, 85.0);
  const Pose held = motion.X_WE();
  for (int i = 0; i < 300; ++i) motion.step({Pose{held.p - Vector3(0.1 * i * kDt, 0, 0), from.q}, {}, kDt});
  EXPECT_LT(motion.X_WE().p.x(), held.p.x() - 1e-3);
}

// It reaches few poses, so its lines have no ends: it moves to the nearest pose.
TEST(CommandedLine, DoesNotApplyToArmsWithFewerJoints) {
  RobotConfig robot = test::space_arm();
  robot.joint[4].kind = JointKind::kFixed;
  const Inverse inverse(robot);
  CommandedLine line(inverse, robot, wide());
  EXPECT_FALSE(line.applies());
  const Twist wanted{Vector3::Zero(), Vector3(1.0, 0, 0)};
  EXPECT_EQ(line.limit({}, {}, wanted, kDt).linear, wanted.linear);
  EXPECT_FALSE(line.ended());
}

}  // namespace
}  // namespace longreach::commanded_line_test
