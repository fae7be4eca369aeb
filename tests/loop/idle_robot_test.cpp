// A robot that nobody has engaged, in the laboratory: whoever moves it, it stays where it was put.

#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach::idle_robot_test {
namespace {

void run(Laboratory& lab, double seconds) {
  const double end_s = lab.now_s() + seconds;
  while (lab.now_s() < end_s) lab.step();
}

JointVector joints_of(const SlaveConfig& slave) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) q[i] = slave.robot.joint[static_cast<std::size_t>(i)].start_rad;
  return q;
}

TEST(IdleRobot, StaysWhereItWasPutAndIsEngagedThere) {
  const proto::LabConfig config = configure(
      {"profile=lab", "scene_file=scenes/free.txtpb", "profile=lab", "safety.engage_at_start=false"},
      LONGREACH_DEPLOY);
  const SlaveConfig slave = to_struct(config.slave());
  Laboratory lab(to_struct(config.master()), slave, 1);
  lab.drive({});
  run(lab, 1.0);
  JointVector q = joints_of(slave);
  const Vector3 start_m = lab.arm().true_pose().p;
  for (int i = 0; i < 500; ++i) {
    q[0] += 0.2e-3;
    lab.arm().displace(q);
    lab.step();
  }
  const Vector3 at_m = lab.arm().true_pose().p;
  ASSERT_GT((at_m - start_m).norm(), 0.3);
  run(lab, 60.0);
  EXPECT_EQ(lab.slave().state, SafetyState::kObserving);
  EXPECT_EQ(lab.arm().true_pose().p, at_m);
  lab.requests().engage = true;
  double first_m = -1.0;  // way in the tick in which it is engaged
  for (int i = 0; i < 3000; ++i) {
    lab.step();
    const double way_m = (lab.arm().true_pose().p - at_m).norm();
    first_m = lab.slave().state == SafetyState::kEngaged && first_m < 0.0 ? way_m : first_m;
    ASSERT_LT(way_m, 1e-3) << i;
  }
  EXPECT_EQ(lab.slave().state, SafetyState::kEngaged);
  EXPECT_LT(first_m, 1e-6);
  EXPECT_EQ(lab.slave().limit_violations, 0U);
}

}  // namespace
}  // namespace longreach::idle_robot_test
