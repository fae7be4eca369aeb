// What a device, a robot or a force sensor reports and cannot be: both programs, with a device and a robot
// behind adapter sockets. Whatever is reported, the robot is not moved by it.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/process/device_box.hpp"
#include "tests/process/robot_box.hpp"
#include "tests/support/station.hpp"

namespace longreach::implausible_test {
namespace {

using std::chrono::seconds;

constexpr double kWall_m = 0.02;

class Implausible : public Station {
 protected:
  void start(const std::vector<std::string>& slave_settings = {}, bool engages = false) {
    std::vector<std::string> slave{"--adapter", robot_.address(),
                                   "--set",     "robot_file=robots/cartesian.txtpb",
                                   "--set",     "robot_adapter.silence_s=0.5"};
    for (const std::string& setting : slave_settings) slave.insert(slave.end(), {"--set", setting});
    start_slave(slave);
    std::vector<std::string> master{"--adapter", device_.address(), "--set", "device_adapter.silence_s=0.5",
                                    "--set",     "mapping.scale=1"};
    if (engages) master.emplace_back("--engage");
    start_master(master);
    ASSERT_TRUE(eventually([this] {
      const auto s = master_.status();
      return s && s->link().rtt_known() && slave_.state() != "Idle";
    })) << outputs();
  }
  /// Runs for this number of datagrams of the robot.
  bool passes(std::uint64_t datagrams) {
    const std::uint64_t end = robot_.reported() + datagrams;
    return eventually([&] { return robot_.reported() >= end; });
  }
  /// Presses on the wall with about 5 N.
  void press() {
    robot_.wall(kWall_m);
    ASSERT_TRUE(engaged()) << outputs();
    device_.move_to(0.025);
    ASSERT_TRUE(eventually([this] {
      const auto s = slave_.status();
      return s && s->in_contact() && s->force_n() > 3.0;
    })) << outputs();
  }
  void expect_fault(const std::string& cause) {
    EXPECT_TRUE(eventually([this] { return slave_.state() == "Fault"; }, seconds(20))) << outputs();
    EXPECT_EQ(slave_.status()->cause(), cause) << outputs();
  }

  RobotBox robot_;
  DeviceBox device_;
};

// The tool moves further into the wall at 20 mm/s.
TEST_F(Implausible, SensorThatReadsZeroInContactIsFaultWithinTwoMillimetres) {
  start();
  press();
  device_.move_to(0.07);
  const double at_m = robot_.joint(2);
  robot_.set_flaw(SensorFlaw::kZero);
  expect_fault("sensor fault");
  ASSERT_TRUE(passes(300));
  const double further_m = robot_.joint(2) - at_m;
  std::printf("%.2f mm after the sensor began to read zero\n", 1e3 * further_m);
  EXPECT_LT(further_m, 3e-3);
}

TEST_F(Implausible, SensorThatFreezesAtRestIsFault) {
  start();
  press();
  ASSERT_TRUE(eventually([this] { return device_.at_m() >= 0.025; }));
  robot_.set_flaw(SensorFlaw::kFrozen);
  expect_fault("sensor fault");
}

TEST_F(Implausible, SensorThatReadsZeroFromStartIsNotEngaged) {
  robot_.set_flaw(SensorFlaw::kZero);
  start();
  ASSERT_TRUE(passes(500));
  const std::string why = master_.engage();
  EXPECT_TRUE(eventually([this] {
    return master_.status()->refusal().find("the force sensor has reported only one value since the start") !=
           std::string::npos;
  })) << why
      << outputs();
  EXPECT_NE(master_.status()->refusal().find("sensing.force"), std::string::npos)
      << master_.status()->refusal();
  ASSERT_TRUE(passes(500));
  EXPECT_EQ(robot_.live(), 0U);
}

TEST_F(Implausible, SensorOfThreeAxesNeedsThatSetting) {
  robot_.set_flaw(SensorFlaw::kNoMoment);
  start();
  ASSERT_TRUE(passes(500));
  (void)master_.engage();
  EXPECT_TRUE(eventually([this] {
    return master_.status()->refusal().find("only one value of the moment") != std::string::npos;
  })) << outputs();
}

TEST_F(Implausible, SensorsThatAreSetToBeMissingAreEngaged) {
  robot_.set_flaw(SensorFlaw::kNoMoment);
  start({"sensing.moment=false"});
  EXPECT_TRUE(engaged()) << outputs();
}

TEST_F(Implausible, JumpOfHandleIsFaultAndNotFollowed) {
  start();
  ASSERT_TRUE(engaged()) << outputs();
  for (const double jump_m : {0.06, 0.052, -0.05}) {
    ASSERT_TRUE(passes(300));
    const double at_m = robot_.joint(2);
    device_.jump(jump_m);
    ASSERT_TRUE(eventually([this] { return master_.state() == "Fault" && slave_.state() == "Holding"; }))
        << outputs();
    EXPECT_EQ(master_.status()->cause(), "handle jumped");
    ASSERT_TRUE(passes(500));
    EXPECT_LT(std::abs(robot_.joint(2) - at_m), 5e-4) << jump_m;
    // An engagement starts where the handle is.
    ASSERT_TRUE(engaged()) << outputs();
    ASSERT_TRUE(passes(500));
    EXPECT_LT(std::abs(robot_.joint(2) - at_m), 5e-4) << jump_m;
  }
}

TEST_F(Implausible, DeviceInMillimetresIsRefused) {
  device_.scale(1000.0);
  device_.move_to(0.001);
  ASSERT_TRUE(eventually([this] { return device_.at_m() >= 0.001; }));
  start();
  ASSERT_TRUE(eventually([this] { return master_.state() == "Fault"; })) << outputs();
  EXPECT_EQ(master_.status()->cause(), "handle outside");
  (void)master_.engage();
  ASSERT_TRUE(eventually([this] { return !master_.status()->refusal().empty(); })) << outputs();
  const std::string why = master_.status()->refusal();
  EXPECT_NE(why.find("the handle is 1 m from its home position"), std::string::npos) << why;
  EXPECT_NE(why.find("metres"), std::string::npos) << why;
  device_.move_to(-0.005);
  ASSERT_TRUE(eventually([this] { return device_.at_m() <= -0.005; }));
  EXPECT_EQ(robot_.live(), 0U);
  EXPECT_LT(device_.force_max_n(), 0.5);
}

TEST_F(Implausible, DeviceInMillimetresAtHomeIsFaultWhenItMoves) {
  device_.scale(1000.0);
  start();
  ASSERT_TRUE(engaged()) << outputs();
  const double at_m = robot_.joint(2);
  device_.move_to(0.01);
  ASSERT_TRUE(eventually([this] { return master_.state() == "Fault" && slave_.state() == "Holding"; }))
      << outputs();
  const std::string cause = master_.status()->cause();
  EXPECT_TRUE(cause == "handle outside" || cause == "handle jumped") << cause;
  ASSERT_TRUE(passes(500));
  std::printf("%s: the robot followed %.1f mm, %.1f N on the hand\n", cause.c_str(),
              1e3 * std::abs(robot_.joint(2) - at_m), device_.force_max_n());
  EXPECT_LT(std::abs(robot_.joint(2) - at_m), 0.01);
  EXPECT_LT(device_.force_max_n(), 2.0);
}

TEST_F(Implausible, QuaternionInAnotherOrderIsRefused) {
  device_.swap_quaternion();
  start();
  ASSERT_TRUE(eventually([this] { return master_.state() == "Fault"; })) << outputs();
  EXPECT_EQ(master_.status()->cause(), "handle outside");
  (void)master_.engage();
  EXPECT_TRUE(eventually([this] { return master_.status()->refusal().find("w x y z") != std::string::npos; }))
      << outputs();
}

TEST_F(Implausible, EndOfFaultDoesNotStartRefusedEngagement) {
  robot_.fail(true);
  start({}, true);
  ASSERT_TRUE(eventually([this] {
    return master_.status()->refusal().find("the robot reports a fault") != std::string::npos;
  })) << outputs();
  ASSERT_TRUE(passes(500));
  robot_.fail(false);
  ASSERT_TRUE(passes(6000));
  EXPECT_EQ(robot_.live(), 0U);
  EXPECT_NE(master_.state(), "Engaged");
  ASSERT_TRUE(engaged()) << outputs();
  EXPECT_GT(robot_.live(), 0U);
}

struct Checked {
  int status = -1;
  std::string output;
};

Checked check(const DeviceBox& device, const std::vector<std::string>& more) {
  std::vector<std::string> words{"adapter", "check", "--device", device.address()};
  words.insert(words.end(), more.begin(), more.end());
  RunningProgram client("longreach", words);
  const int status = client.wait(seconds(60)).value_or(-1);
  return {status, client.output()};
}

TEST(AdapterCheckOfHandle, FindsJumpsAndUnits) {
  const std::vector<std::string> described{"--device-file", "devices/desktop.txtpb"};
  {
    const DeviceBox device;
    const Checked checked = check(device, described);
    EXPECT_NE(checked.output.find("the handle did not jump"), std::string::npos) << checked.output;
    EXPECT_NE(checked.output.find("workspace 0.075 m"), std::string::npos) << checked.output;
  }
  {
    DeviceBox device;
    device.chatter(0.06);
    const Checked checked = check(device, {});
    EXPECT_EQ(checked.status, 1);
    EXPECT_NE(checked.output.find("the position of the handle jumped by 0.06 m"), std::string::npos)
        << checked.output;
  }
  {
    DeviceBox device;
    device.scale(1000.0);
    device.move_to(0.001);
    while (device.at_m() < 0.001) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Checked checked = check(device, described);
    EXPECT_EQ(checked.status, 1);
    EXPECT_NE(checked.output.find("the handle is up to 1 m from home"), std::string::npos) << checked.output;
    EXPECT_NE(checked.output.find("the values seem to be in millimetres"), std::string::npos)
        << checked.output;
  }
  {
    DeviceBox device;
    device.swap_quaternion();
    const Checked checked = check(device, described);
    EXPECT_EQ(checked.status, 1);
    EXPECT_NE(checked.output.find("in the order w x y z"), std::string::npos) << checked.output;
  }
}

TEST(AdapterCheckOfHandle, WarnsOfConstantSensor) {
  RobotBox robot;
  robot.set_flaw(SensorFlaw::kZero);
  RunningProgram client("longreach", {"adapter", "check", "--robot", robot.address()});
  EXPECT_TRUE(client.wait(seconds(60)));
  EXPECT_NE(client.output().find("the force has a single value"), std::string::npos) << client.output();
  EXPECT_NE(client.output().find("sensing.force=false"), std::string::npos) << client.output();
}

}  // namespace
}  // namespace longreach::implausible_test
