// longreach-mujoco as the robot of the real programs: a wall touched by keyboard, faults, and mistakes.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::mujoco_test {
namespace {

const std::string kScenes = std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/";

class Mujoco : public Station {
 protected:
  void start_robot(const std::string& scene, const std::vector<std::string>& more = {}) {
    const std::string robot = (folder_.path() / "robot.txtpb").string();
    address_ = "unix:" + (folder_.path() / "robot").string();
    std::vector<std::string> words{scene, address_, "--write-robot", robot};
    words.insert(words.end(), more.begin(), more.end());
    robot_program_ = std::make_unique<RunningProgram>("longreach-mujoco", words);
    ASSERT_TRUE(says(*robot_program_, "listening on " + address_)) << robot_program_->output();
  }
  void start_both(const std::string& profile, const std::string& silence_s) {
    start_slave({"--adapter", address_, "--profile", profile, "--set",
                 "robot_file=" + (folder_.path() / "robot.txtpb").string(), "--set",
                 "robot_adapter.silence_s=" + silence_s, "--set", "link.impairment.rpc_delay_s=0"});
    start_master({"--operator", "keyboard", "--engage", "--profile", profile, "--set", "hand.grip=FIRM"},
                 {terminal_.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs() << robot_program_->output();
  }

  TemporaryFolder folder_;
  std::string address_;
  std::unique_ptr<RunningProgram> robot_program_;
  Terminal terminal_;
};

TEST_F(Mujoco, AWallTouchedByKeyboardIsFelt) {
  // A first value may be 6 % off and stays within the dead band of 8 % (estimator.deadband) of a better one.
  constexpr double kWall_n_per_m = 5000.0, kTolerance = 0.1;
  for (const char* profile : {"lab", "moon"}) {
    start_robot(kScenes + "wall.xml");
    start_both(profile, "0.5");
    terminal_.type("WWWWWWWWWWWW");  // 60 mm at the hand: the wall is 30 mm in front of the tool
    const auto felt = [this] { return master_.status().value_or(proto::Status{}).stiffness_n_per_m(); };
    EXPECT_TRUE(eventually([&] { return felt() > 0.0; })) << outputs();
    std::this_thread::sleep_for(std::chrono::seconds(5));
    std::printf("%s: a wall of %.0f N/m is felt with %.0f N/m, the tool presses with %.2f N\n", profile,
                kWall_n_per_m, felt(), slave_.status().value_or(proto::Status{}).force_n());
    EXPECT_NEAR(felt(), kWall_n_per_m, kTolerance * kWall_n_per_m) << outputs();
    EXPECT_EQ(slave_.state(), "Engaged") << outputs();
    terminal_.type("q");
    EXPECT_EQ(master_program_->wait(std::chrono::seconds(30)), 0) << outputs();
    master_program_.reset();
    slave_program_.reset();
    robot_program_->signal(SIGTERM);
    EXPECT_EQ(robot_program_->wait(std::chrono::seconds(10)), 0);
  }
}

TEST_F(Mujoco, WhenItEndsTheSlaveHoldsAndSaysWhy) {
  start_robot(kScenes + "wall.xml");
  start_both("lab", "0.02");
  robot_program_->signal(SIGKILL);
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Fault"; })) << outputs();
  EXPECT_TRUE(says(*slave_program_, "robot fault")) << outputs();
}

TEST_F(Mujoco, AResetHoldsAndTheWorkGoesOn) {
  start_robot(kScenes + "wall.xml");
  start_both("lab", "0.5");
  terminal_.type("WWWWWWWWWWWW");
  const auto force_n = [this] { return slave_.status().value_or(proto::Status{}).force_n(); };
  EXPECT_TRUE(eventually([&] { return force_n() > 1.0; })) << outputs();
  robot_program_->signal(SIGUSR1);
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Fault"; })) << outputs();
  EXPECT_TRUE(says(*slave_program_, "robot fault")) << outputs();
  EXPECT_TRUE(eventually([&] { return force_n() < 0.5; })) << outputs();
  terminal_.type("e");
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_LT(force_n(), 0.5) << "the robot is at its start, in front of the wall";
  EXPECT_TRUE(robot_program_->running()) << robot_program_->output();
}

// The virtual display keeps its picture in a file.
TEST_F(Mujoco, AWindowShowsTheWorld) {
  RunningProgram display(
      "/usr/bin/Xvfb", {"-displayfd", "1", "-screen", "0", "1024x768x24", "-fbdir", folder_.path().string()});
  ASSERT_TRUE(eventually([&] { return display.output().find('\n') != std::string::npos; }));
  ::setenv("DISPLAY", (":" + display.output().substr(0, display.output().find('\n'))).c_str(), 1);
  start_robot(kScenes + "corner.xml", {"--view"});
  ::unsetenv("DISPLAY");
  const auto colours = [this] {
    std::ifstream file(folder_.path() / "Xvfb_screen0", std::ios::binary);
    std::set<std::uint32_t> seen;
    for (std::uint32_t pixel = 0; file.read(reinterpret_cast<char*>(&pixel), sizeof pixel);)
      seen.insert(pixel);
    return seen.size();
  };
  EXPECT_TRUE(eventually([&] { return colours() > 100; })) << colours() << " colours";
  robot_program_->signal(SIGTERM);
  EXPECT_EQ(robot_program_->wait(std::chrono::seconds(10)), 0) << robot_program_->output();
}

TEST_F(Mujoco, ASceneThatIsTooSlowIsSaidAndEnds) {
  std::filesystem::copy_file(kScenes + "arm.xml", folder_.path() / "arm.xml");
  const std::string scene =
      folder_
          .write("slow.xml",
                 R"(<mujoco model="slow"><include file="arm.xml"/><option timestep="2e-6"/></mujoco>)")
          .string();
  start_robot(scene);
  EXPECT_EQ(robot_program_->wait(std::chrono::seconds(60)), 1);
  const std::string said = robot_program_->output();
  EXPECT_NE(said.find("longreach-mujoco: the simulation reaches "), std::string::npos) << said;
  EXPECT_NE(said.find(" % of real time; use a simpler scene or a larger time step\n"), std::string::npos)
      << said;
}

/// Six joints of links of 1 kg, and two frames on the last link.
std::string urdf() {
  std::string text = "<robot name='six'><link name='l0'/>\n";
  for (int i = 1; i <= 6; ++i) {
    const std::string n = std::to_string(i);
    text += "<joint name='j" + n + "' type='revolute'><parent link='l" + std::to_string(i - 1) +
            "'/><child link='l" + n + "'/><origin xyz='0.1 0 0.2'/><axis xyz='" +
            (i % 2 == 0 ? "0 1 0" : "0 0 1") +
            "'/><limit lower='-2' upper='2' velocity='1.5' effort='50'/></joint><link name='l" + n +
            "'><inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' "
            "iyz='0'/></inertial></link>\n";
  }
  for (const std::string tip : {"flange", "tip"})
    text += "<link name='" + tip + "'/><joint name='to_" + tip +
            "' type='fixed'><parent link='l6'/><child link='" + tip + "'/></joint>\n";
  return text + "</robot>";
}

std::string status_and_output(const std::string& name, const std::vector<std::string>& words) {
  RunningProgram program(name, words);
  const int status = program.wait(std::chrono::seconds(20)).value_or(-1);
  return std::to_string(status) + " " + program.output();
}

TEST_F(Mujoco, AUrdfIsTheArmThatTheClientShows) {
  const std::string arm = folder_.write("arm.urdf", urdf()), file = folder_.path() / "arm.txtpb";
  EXPECT_EQ(status_and_output("longreach-mujoco", {arm, "--write-robot", file}),
            "2 longreach-mujoco: " + arm +
                ":1: 2 end links have 6 moving joints before them (flange, tip); name the tool in --tool\n");
  EXPECT_EQ(status_and_output("longreach-mujoco", {arm, "--write-robot", file, "--tool", "tip"}),
            "0 longreach-mujoco: warning: the tool link tip carries no shape for collisions, so the sensors "
            "there measure no contact\n");
  const auto joints = [](const std::string& shown) { return shown.substr(0, shown.find("limits ")); };
  EXPECT_EQ(joints(status_and_output("longreach", {"robot", "show", arm, "--tip-link", "tip"})),
            joints(status_and_output("longreach", {"robot", "show", file})));
}

TEST_F(Mujoco, MistakesAreOneSentenceAndExitStatus2) {
  const auto run = [](const std::vector<std::string>& words) {
    return status_and_output("longreach-mujoco", words);
  };
  const std::string wall = kScenes + "wall.xml", address = "unix:" + (folder_.path() / "robot").string();
  EXPECT_EQ(run({wall}),
            "2 longreach-mujoco: nothing to do: give an ADDRESS to serve the robot, or --write-robot FILE\n");
  EXPECT_EQ(run({wall, "tcp:1"}), "2 longreach-mujoco: tcp:1: an address is unix:/PATH\n");
  EXPECT_EQ(run({wall, "--write-robot", "/dev/null", "--view"}),
            "2 longreach-mujoco: --view: give an ADDRESS to serve the robot\n");
  ::setenv("DISPLAY", ":none", 1);
  EXPECT_EQ(
      run({wall, address, "--view"}),
      "1 longreach-mujoco: --view: no window can be opened (X11: Failed to open display :none); it needs a "
      "display with OpenGL\n");
  ::unsetenv("DISPLAY");
  EXPECT_EQ(run({"/none.xml", address}), "2 longreach-mujoco: /none.xml: there is no such file\n");
  EXPECT_EQ(run({wall, "unix:/none/x"}),
            "1 longreach-mujoco: /none/x: cannot listen: No such file or directory\n");
  EXPECT_EQ(run({wall, address, "--rate", "1500"}),
            "2 longreach-mujoco: " + wall +
                ": the time step of 0.000200 s does not divide the period of 0.000667 s (--rate)\n");
  const std::string other = std::string(LONGREACH_DEPLOY) + "/robots/puma560.txtpb";
  EXPECT_NE(run({wall, address, "--robot", other})
                .find("2 longreach-mujoco: " + other + ": describes another arm than " + wall),
            std::string::npos);
}

}  // namespace
}  // namespace longreach::mujoco_test
