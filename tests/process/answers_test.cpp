// An operator is never left without the reason: engagements that are not granted, ends of runs, links that
// get better.
#include <csignal>

#include "tests/process/robot_box.hpp"
#include "tests/support/station.hpp"

namespace longreach::answers_test {
namespace {

using std::chrono::seconds;

class Answers : public Station {
 protected:
  struct Said {
    int status = -1;
    std::string text;
    [[nodiscard]] bool has(const std::string& words) const { return text.find(words) != std::string::npos; }
  };
  [[nodiscard]] Said client(std::vector<std::string> words) const {
    for (const char* side : {"--slave", "--master"}) {
      words.emplace_back(side);
      words.push_back("127.0.0.1:" +
                      std::to_string(words.back() == "--slave" ? ports_.slave_rpc : ports_.master_rpc));
    }
    RunningProgram program("longreach", words);
    const int status = program.wait(seconds(60)).value_or(-1);
    return {status, program.output()};
  }
  void start_with(RobotBox& robot, const std::vector<std::string>& master = {"--operator", "none"}) {
    start_slave({"--adapter", robot.address(), "--set", "robot_file=robots/cartesian.txtpb", "--set",
                 "robot_adapter.silence_s=0.5", "--set", "command.workspace_m=3"});
    start_master(master);
    ASSERT_TRUE(eventually([this] { return master_.state() == "Observing" && slave_.state() != "Idle"; }))
        << outputs();
  }
};

// As an IRB120 with q5 = 2.15, whose limit is 2.094.
TEST_F(Answers, RobotBeyondLimitIsNotEngagedAndErrorNamesJoint) {
  RobotBox robot;
  const auto carry = [&robot](double m_per_s, const std::function<bool()>& there) {
    robot.push(m_per_s);
    EXPECT_TRUE(eventually(there));
    robot.push(0.0);
  };
  carry(0.4, [&] { return robot.joint(2) > 1.003; });
  start_with(robot);
  const std::string where = "at the slave: joint 3 of the robot is at 1.0",
                    advice =
                        "beyond its limit of 1; move the joint back with the robot's own controls, then "
                        "engage";
  const Said said = client({"engage"});
  EXPECT_EQ(said.status, 1) << said.text;
  EXPECT_TRUE(said.has("not engaged: " + where) && said.has(advice)) << said.text << outputs();
  const Said status = client({"status"});
  EXPECT_TRUE(status.has("Not engaged: " + where) && status.has(advice)) << status.text;
  EXPECT_TRUE(says(*master_program_, "cause=\"joint limit\"")) << outputs();
  EXPECT_TRUE(says(*slave_program_, "cause=\"joint limit\"")) << outputs();
  carry(-0.1, [&] { return robot.joint(2) < 0.9; });
  ASSERT_TRUE(engaged()) << outputs();
  EXPECT_EQ(master_.status()->refusal(), "");
}

// An adapter that is used with the wrong robot file.
TEST_F(Answers, AJointFarBeyondItsLimitsIsNamedAtTheMaster) {
  RobotBox robot;
  robot.sensor_fault(30.0);
  start_with(robot, {"--operator", "none", "--view", "plain", "--engage"});
  const std::string where = "at the slave: joint 3 of the robot is at 30 rad (or m), beyond its limit of 1";
  ASSERT_TRUE(eventually([&] { return master_.status()->refusal().starts_with(where); })) << outputs();
  EXPECT_EQ(slave_.status()->cause(), "joint outside");
  EXPECT_TRUE(says(*master_program_, where)) << outputs();
  EXPECT_TRUE(says(*master_program_, "check robot_file")) << outputs();
}

TEST_F(Answers, RunThatEndsInFaultFailsAndReportsEngagedShare) {
  start_slave();
  start_master({"--operator", "none", "--engage", "--view", "plain", "--seconds", "600"});
  ASSERT_TRUE(both_engaged()) << outputs();
  slave_program_->signal(SIGKILL);
  ASSERT_TRUE(eventually([this] { return master_.state() == "Holding"; })) << outputs();
  master_program_->signal(SIGTERM);
  ASSERT_TRUE(master_program_->wait(seconds(30)));
  const std::string text = master_program_->output();
  EXPECT_NE(text.find("  event held at "), std::string::npos) << text;
  EXPECT_NE(text.find(" s until the end: no datagrams arrive from the other side"), std::string::npos)
      << text;
  EXPECT_NE(text.find("verdict: ended in a fault: at the end: "), std::string::npos) << text;
  EXPECT_NE(text.find(" %)"), std::string::npos) << text;
}

TEST_F(Answers, ImprovedLinkDoesNotHoldAndWorseLinkIsReported) {
  start_slave({"--profile", "moon", "--set", "link.impairment.rpc_delay_s=0"});
  start_master({"--operator", "none", "--profile", "moon"});
  ASSERT_TRUE(engaged()) << outputs();
  const std::uint32_t engagement = master_.status()->engagement();
  EXPECT_EQ(client({"link", "clear"}).status, 0);
  ASSERT_TRUE(eventually([this] {
    return master_.status()->link().rtt_s() < 0.2 && slave_.status()->link().rtt_s() < 0.2;
  })) << outputs();
  std::this_thread::sleep_for(seconds(3));  // what was under way has come by then
  EXPECT_EQ(master_.state(), "Engaged") << master_.status()->cause() << outputs();
  EXPECT_EQ(master_.status()->engagement(), engagement);
  EXPECT_EQ(master_program_->output().find("to=Holding"), std::string::npos) << outputs();
  const Said worse = client({"link", "set", "--delay", "650ms"});
  EXPECT_EQ(worse.status, 0) << worse.text;
  EXPECT_TRUE(worse.has(
      "the round trip rises by 1.3 s, more than safety.delay_rise_max_s = 1: the robot holds; accept the "
      "new delay with `longreach engage`"))
      << worse.text;
  ASSERT_TRUE(eventually([this] { return master_.state() == "Holding"; })) << outputs();
  EXPECT_TRUE(eventually([this] { return client({"engage"}).text.starts_with("engaged"); })) << outputs();
  EXPECT_EQ(master_program_->output().find("no datagrams arrive from"), std::string::npos) << outputs();
}

TEST_F(Answers, ReportsThatRpcWorksButDatagramsDoNot) {
  start_slave();
  start_master({"--operator", "none", "--set", "link.slave=127.0.0.1:9"});
  const std::string why = "responds, but no datagrams arrive from 127.0.0.1:9";
  ASSERT_TRUE(eventually([&] {
    return master_.status() && master_.status()->trouble().find(why) != std::string::npos;
  })) << outputs();
  EXPECT_TRUE(client({"engage"}).has(why));
  EXPECT_TRUE(client({"doctor", "--seconds", "0.3"}).has("no datagrams arrive from"));
  EXPECT_TRUE(says(*master_program_, why)) << outputs();
}

TEST_F(Answers, StartLinesNameAdapterAndFilesAndWhatDoesNotCount) {
  RobotBox robot;
  start_slave({"--adapter", robot.address()});
  EXPECT_TRUE(says(*slave_program_, "robot adapter=" + robot.address())) << outputs();
  EXPECT_TRUE(
      says(*slave_program_,
           "scene_left_out=\"the whole scene, with robot_file and tool_radius_m: the robot is real\""))
      << outputs();
  EXPECT_TRUE(says(*slave_program_, "robot file=default")) << outputs();
  start_master({"--operator", "none"});
  EXPECT_TRUE(says(*master_program_, "device desktop: renders at most 6.")) << outputs();
  EXPECT_TRUE(says(*master_program_, "workspace up to 75 mm")) << outputs();
}

}  // namespace
}  // namespace longreach::answers_test
