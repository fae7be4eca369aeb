// Protections of the real programs: a real robot is guarded whatever the scene, a robot without a force sensor says
// that it is not, and a first touch at any speed stays within the guard's limit.
#include <algorithm>
#include <regex>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::protection_test {
namespace {

constexpr double kGuard_n = 20.0, kOvershoot = 1.35;

class Protections : public Station {
 protected:
  /// The reference robot, in front of a wall of 1 N/mm.
  std::string start_robot() {
    const std::string path = folder_.path() / "robot";
    robot_ = std::make_unique<RunningProgram>("longreach-reference-robot",
                                              std::vector<std::string>{path, "--wall", "0.02"});
    EXPECT_TRUE(eventually([&] { return robot_->output().find("listening on") != std::string::npos; }));
    return "unix:" + path;
  }
  void start(std::vector<std::string> slave, const std::string& mode) {
    start_slave(slave);
    // The guard is tested, so the goal stays where the keys put it.
    start_master(
        {"--operator", "keyboard", "--mode", mode, "--engage", "--set", "mapping.goal_follows_force=false"},
        {terminal_.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
  }
  /// Returns the largest force from now until it has been above 0.7 of the guard for two seconds.
  double largest_force_n() {
    double most_n = 0.0;
    std::optional<std::chrono::steady_clock::time_point> pressed;
    EXPECT_TRUE(eventually([&] {
      const auto now = slave_.status();
      if (!now) return false;
      most_n = std::max(most_n, now->force_n());
      if (now->force_n() < 0.7 * kGuard_n)
        pressed.reset();
      else if (!pressed)
        pressed = std::chrono::steady_clock::now();
      return pressed && std::chrono::steady_clock::now() - *pressed > std::chrono::seconds(2);
    })) << outputs();
    return most_n;
  }
  bool reduced(StationSide& side, const std::string& words) {
    const auto now = side.status();
    return now && std::ranges::any_of(now->reduced_protection(), [&](const std::string& sentence) {
             return sentence.find(words) != std::string::npos;
           });
  }

  TemporaryFolder folder_;
  const Terminal terminal_;
  std::unique_ptr<RunningProgram> robot_;
};

class ProtectionOf : public Protections, public ::testing::WithParamInterface<const char*> {};

// The goal is 80 mm behind the wall: 80 N without the guard.
TEST_P(ProtectionOf, ARealRobotHoldsWhateverTheScene) {
  start({"--adapter", start_robot(), "--set", "robot_file=robots/cartesian.txtpb", "--set",
         std::string("scene_file=scenes/") + GetParam() + ".txtpb"},
        "position");
  terminal_.type("WWWWWWWWWWWWWWWWWWWW");
  EXPECT_LT(largest_force_n(), kOvershoot * kGuard_n);
  EXPECT_TRUE(slave_.status()->in_contact());
  EXPECT_FALSE(reduced(slave_, "no force guard"));
  EXPECT_FALSE(reduced(slave_, "no moment guard"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ProtectionOf, ::testing::Values("free", "hinge"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_F(Protections, WithoutAForceSensorEveryDisplaySaysSo) {
  start({"--set", "sensing.force=false"}, "position");
  EXPECT_TRUE(reduced(slave_, "no force guard"));
  EXPECT_TRUE(eventually([this] { return reduced(master_, "no force guard"); })) << outputs();
  EXPECT_TRUE(says(*slave_program_, "reduced protection=\"no force guard")) << outputs();
  ASSERT_EQ(master_.stop(), "");
  const std::vector<std::string> sides{"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc),
                                       "--slave", "127.0.0.1:" + std::to_string(ports_.slave_rpc)};
  const auto said = [&](std::vector<std::string> words) {
    words.insert(words.end(), sides.begin(), sides.end());
    RunningProgram client("longreach", words);
    client.wait(std::chrono::seconds(60));
    std::string text = client.output();  // wrapped for people
    std::ranges::replace(text, '\n', ' ');
    return std::regex_replace(text, std::regex(" +"), " ");
  };
  const std::string engaged = said({"engage"});
  EXPECT_NE(engaged.find("reduced protection: no force guard"), std::string::npos) << engaged;
  const std::string status = said({"status"});
  EXPECT_NE(status.find("Reduced protection (slave): no force guard"), std::string::npos) << status;
  const std::string doctor = said({"doctor", "--seconds", "0.3"});
  EXPECT_NE(doctor.find("no force guard"), std::string::npos) << doctor;
}

TEST_F(Protections, AFastTouchOfAStiffWallStaysWithinTheGuard) {
  start({"--set", "scene.material.wall.stiffness_n_per_m=20000"}, "rate");
  ASSERT_TRUE(eventually([this] { return slave_.status()->approach_m_per_s() > 0.0; })) << outputs();
  const HeldKey held(terminal_.outer);
  terminal_.type("WWWWWWWWWWWWW");
  EXPECT_LT(largest_force_n(), kOvershoot * kGuard_n);
}

}  // namespace
}  // namespace longreach::protection_test
