// The laboratory's force sensor that lies: each lie is what it says it is, and the slave is told it.

#include "deploy/lab/robot/faulty_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach::faulty_sensor_test {
namespace {

/// What is told of `felt_n`, a tick after the lie began.
Vector3 reported(const SensorFault& sensor_fault, const Vector3& felt_n, double t_s = 1e-3) {
  FaultySensor sensor{RobotConfig{}};
  sensor.sensor_fault(sensor_fault);
  RobotState robot;
  robot.F_F_W.force = felt_n;
  sensor.apply(Time{}, robot);
  robot.F_F_W.force = 2.0 * felt_n;
  sensor.apply(Time{} + from_seconds(t_s), robot);
  return robot.F_F_W.force;
}

TEST(FaultySensor, EachLieIsWhatItSays) {
  const Vector3 felt(1.0, 2.0, 3.0);
  const Vector3 x = Vector3::UnitX();
  const auto far = [](const Vector3& a, const Vector3& b) { return (a - b).norm(); };
  EXPECT_LT(far(reported({SensorFaultKind::kNone, 9.0}, felt), 2.0 * felt), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kBias, 9.0, x}, felt), 2.0 * felt + 9.0 * x), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kDrift, 9.0, x}, felt, 0.5), 2.0 * felt + 4.5 * x), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kStuck, 9.0, x}, felt), 9.0 * x), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kFrozen}, felt), felt), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kSpike, 9.0, x}, felt), 2.0 * felt), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kSpike, 9.0, x, 1e-3}, felt), 9.0 * x), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kSaturation, 3.0}, felt), Vector3(2.0, 3.0, 3.0)), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kSign}, felt), -2.0 * felt), 1e-12);
  EXPECT_LT(
      far(reported({SensorFaultKind::kFrame, 0.5 * std::numbers::pi, x}, felt), Vector3(2.0, -6.0, 4.0)),
      1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kAxes}, felt), Vector3(4.0, 6.0, 2.0)), 1e-12);
  EXPECT_LT(far(reported({SensorFaultKind::kScale, 0.5}, felt), felt), 1e-12);
}

TEST(FaultySensor, TheLaboratorysSlaveIsToldTheLie) {
  const proto::LabConfig config = configure({"profile=lab"}, LONGREACH_DEPLOY);
  const SlaveConfig slave = to_struct(config.slave());
  Laboratory lab(to_struct(config.master()), slave, 1);
  FaultySensor sensor(slave.robot);
  OnRobot hooks([&](Time now, RobotState& robot) { sensor.apply(now, robot); });
  lab.set_fault_hooks(hooks);
  for (int i = 0; i < 50; ++i) lab.step();
  EXPECT_LT(lab.slave().F_E_W.force.norm(), 1.0);
  sensor.sensor_fault({SensorFaultKind::kBias, 3.0});
  for (int i = 0; i < 50; ++i) lab.step();
  EXPECT_NEAR(lab.slave().F_E_W.force.norm(), 3.0, 0.5);
  EXPECT_EQ(lab.arm().true_wrench().force.norm(), 0.0);
}

}  // namespace
}  // namespace longreach::faulty_sensor_test
