#include "slave/command/limit_watch.hpp"

#include <gtest/gtest.h>

namespace longreach::limit_watch_test {
namespace {

constexpr double kDt = 1e-3;

/// At rest at zero, then wherever a test puts the joints or the tool.
struct Watched {
  Watched() {
    for (JointConfig& joint : robot.joint) {
      joint.min_rad = -1.0;
      joint.max_rad = 1.0;
      joint.speed_max_rad_per_s = joint.acceleration_max_rad_per_s2 = joint.jerk_max_rad_per_s3 = 1e12;
    }
    command.speed_max_m_per_s = command.speed_max_rad_per_s = 1e12;
    command.acceleration_max_m_per_s2 = command.acceleration_max_rad_per_s2 = 1e12;
  }
  LimitViolations at(const JointVector& joint_rad, const Vector3& tool_m = Vector3::Zero(),
                     const Vector3& tool_rad = Vector3::Zero()) const {
    LimitWatch watch(robot);
    watch.reset(JointVector::Zero(), Pose{});
    const Pose X_WE{tool_m, exp_rotation(tool_rad)};
    watch.step(joint_rad, X_WE, command, kDt);
    EXPECT_LE(watch.violations(), 1u);
    return watch.by_limit();
  }

  RobotConfig robot{};
  CommandConfig command{};
};

JointVector joint(int number, double rad) {
  JointVector out = JointVector::Zero();
  out[number - 1] = rad;
  return out;
}

TEST(LimitWatch, NamesTheLimitAndTheJoint) {
  Watched watched;
  EXPECT_EQ(watched.at(joint(3, 0.9)).first, Limit::kCount);
  LimitViolations found = watched.at(joint(3, 1.1));
  EXPECT_EQ(found.first, Limit::kJointPosition);
  EXPECT_EQ(found.joint, 3);
  EXPECT_EQ(found.of(Limit::kJointPosition), 1u);
  EXPECT_EQ(found.of(Limit::kJointSpeed), 0u);
  watched.robot.joint[4].speed_max_rad_per_s = 1.0;
  found = watched.at(joint(5, 0.1));
  EXPECT_EQ(found.first, Limit::kJointSpeed);
  EXPECT_EQ(found.joint, 5);
  watched.robot.joint[0].acceleration_max_rad_per_s2 = 1.0;
  EXPECT_EQ(watched.at(joint(1, 0.1)).first, Limit::kJointAcceleration);
  watched.robot.joint[1].jerk_max_rad_per_s3 = 1.0;
  EXPECT_EQ(watched.at(joint(2, 0.1)).first, Limit::kJointJerk);
}

TEST(LimitWatch, EachLimitHoldsBothWays) {
  for (const double way : {-1.0, 1.0}) {
    Watched watched;
    EXPECT_EQ(watched.at(joint(2, way)).first, Limit::kCount);
    EXPECT_EQ(watched.at(joint(2, 1.000001 * way)).first, Limit::kJointPosition) << way;
    watched.robot.joint[1].speed_max_rad_per_s = 100.0;
    EXPECT_EQ(watched.at(joint(2, 0.1009 * way)).first, Limit::kCount) << "within 1 %";
    EXPECT_EQ(watched.at(joint(2, 0.1011 * way)).first, Limit::kJointSpeed) << way;
    watched.robot.joint[1].speed_max_rad_per_s = 1e12;
    watched.command.speed_max_rad_per_s = 100.0;
    EXPECT_EQ(watched.at(JointVector::Zero(), Vector3::Zero(), Vector3(0, 0.1009 * way, 0)).first,
              Limit::kCount);
    EXPECT_EQ(watched.at(JointVector::Zero(), Vector3::Zero(), Vector3(0, 0.1011 * way, 0)).first,
              Limit::kToolSpeed);
    watched.command.speed_max_rad_per_s = 1e12;
    watched.command.acceleration_max_rad_per_s2 = 1e5;
    EXPECT_EQ(watched.at(JointVector::Zero(), Vector3::Zero(), Vector3(0.1011 * way, 0, 0)).first,
              Limit::kToolAcceleration);
  }
}

TEST(LimitWatch, TheFirstLimitIsKeptAndTheOthersAreCounted) {
  Watched watched;
  watched.command.acceleration_max_rad_per_s2 = 1.0;
  LimitWatch watch(watched.robot);
  watch.reset(JointVector::Zero(), Pose{});
  watch.step(joint(4, 1.5), Pose{}, watched.command, kDt);
  watch.step(joint(2, -1.5), Pose{}, watched.command, kDt);
  watch.step(JointVector::Zero(), Pose{Vector3::Zero(), exp_rotation(Vector3(0, 0, 0.1))}, watched.command,
             kDt);
  EXPECT_EQ(watch.violations(), 3u);
  EXPECT_EQ(watch.by_limit().first, Limit::kJointPosition);
  EXPECT_EQ(watch.by_limit().joint, 4);
  EXPECT_EQ(watch.by_limit().of(Limit::kJointPosition), 2u);
  EXPECT_EQ(watch.by_limit().of(Limit::kToolAcceleration), 1u);
}

TEST(LimitWatch, TellsTheToolsLimitsFromThoseOfTheJoints) {
  Watched watched;
  const Vector3 moved(0.01, 0.0, 0.0);
  EXPECT_EQ(watched.at(JointVector::Zero(), moved).first, Limit::kCount);
  watched.command.speed_max_m_per_s = 1.0;
  const LimitViolations fast = watched.at(JointVector::Zero(), moved);
  EXPECT_EQ(fast.first, Limit::kToolSpeed);
  EXPECT_EQ(fast.joint, 0);
  watched.command.speed_max_m_per_s = 1e12;
  watched.command.acceleration_max_m_per_s2 = 1.0;
  EXPECT_EQ(watched.at(JointVector::Zero(), moved).first, Limit::kToolAcceleration);
}

TEST(LimitWatch, CountsEachLimitThatIsExceededInATick) {
  Watched watched;
  watched.robot.joint[2].speed_max_rad_per_s = 1.0;
  const LimitViolations found = watched.at(joint(3, 1.1));
  EXPECT_EQ(found.first, Limit::kJointPosition);
  EXPECT_EQ(found.of(Limit::kJointPosition), 1u);
  EXPECT_EQ(found.of(Limit::kJointSpeed), 1u);
  EXPECT_EQ(name_of(found.first), "joint position");
  EXPECT_EQ(name_of(Limit::kCount), "none");
}

}  // namespace
}  // namespace longreach::limit_watch_test
