// What a person does at the keyboard of the real programs: holds the handle out against a wall, comes back to
// one that is known, passes beside a box.
#include <cmath>
#include <fstream>
#include <thread>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::person_test {
namespace {

class Person : public Station {
 protected:
  void start(const std::vector<std::string>& slave, const std::string& mode,
             std::vector<std::string> master = {}) {
    start_slave(slave);
    master.insert(master.end(), {"--operator", "keyboard", "--mode", mode, "--engage"});
    start_master(master, {terminal_.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
    anchor_m_ = tool_x_m() - goal_x_m();
  }
  double tool_x_m() {
    const auto now = slave_.status();
    return now && now->tool_m_size() == 3 ? now->tool_m(0) : NAN;
  }
  double goal_x_m() {
    const auto now = master_.status();
    return now && now->goal_m_size() == 3 ? now->goal_m(0) : NAN;
  }
  double lead_m() { return goal_x_m() - (tool_x_m() - anchor_m_); }
  bool feels(double least_n, double most_n) {
    return eventually([=, this] {
      const auto now = master_.status();
      return now && now->force_n() >= least_n && now->force_n() <= most_n;
    });
  }
  /// More than this, for a second.
  bool detects_contact(double least_n = 1.0) {
    int times = 0;
    return eventually([&, this] {
      const auto now = master_.status();
      times = now && now->contact_n() > least_n ? times + 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      return times >= 10;
    });
  }
  /// Presses to and fro by a key until the wall is known.
  bool probes() {
    return eventually([this] {
      for (const char* key : {"s", "w"}) {
        terminal_.type(key);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
      }
      const auto now = master_.status();
      return now && now->stiffness_n_per_m() > 1000.0;
    });
  }
  bool touches(bool touches) {
    return eventually([=, this] {
      const auto now = slave_.status();
      return now && now->in_contact() == touches;
    });
  }

  const Terminal terminal_;
  double anchor_m_ = 0.0;
};

TEST_F(Person, HoldsOutAgainstAWallAndTheRetreatIsAnswered) {
  start({"--set", "scene.surface.wall.plane.point_m=0.03,0,0"}, "rate");
  const HeldKey held(terminal_.outer);
  terminal_.type("WWWWWWWW");
  ASSERT_TRUE(eventually([this] {
    const auto now = slave_.status();
    return now && now->force_n() > 1.0;
  })) << outputs();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_LT(lead_m(), 6e-3) << outputs();
  const double pressed_m = tool_x_m();
  terminal_.type("SSSSSSSSSSSS");
  EXPECT_TRUE(eventually([&] { return tool_x_m() < pressed_m - 2e-3; }, std::chrono::seconds(5)))
      << outputs();
}

TEST_F(Person, MovesFreelyInFrontOfAWallThatIsKnown) {
  start({"--set", "scene.surface.wall.plane.point_m=0.03,0,0", "--set",
         "scene.material.wall.stiffness_n_per_m=5000"},
        "position");
  terminal_.type("WWWWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  ASSERT_TRUE(probes()) << outputs();
  terminal_.type(" ");
  ASSERT_TRUE(touches(false)) << outputs();
  ASSERT_TRUE(eventually([this] { return std::abs(goal_x_m()) < 1e-3; })) << outputs();
  terminal_.type("m");
  ASSERT_TRUE(eventually([this] { return master_.status()->mode() == "rate"; })) << outputs();
  const double from_m = tool_x_m();
  const HeldKey held(terminal_.outer);
  terminal_.type("WWW");
  EXPECT_TRUE(eventually([&] { return tool_x_m() > from_m + 5e-3; }, std::chrono::seconds(10))) << outputs();
}

TEST_F(Person, FeelsNothingBesideABoxThatWasTouched) {
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "box.txtpb").string();
  std::ofstream(scene) << "name: 'box'\n"
                          "material { name: 'm' stiffness_n_per_m: 5000 damping_s_per_m: 0.1 }\n"
                          "surface { name: 'box' material: 'm'\n"
                          "  box { centre_m: [0.05, 0, 0] size_m: [0.04, 0.02, 0.04] } }\n";
  start({"--set", "scene_file=" + scene}, "position");
  terminal_.type("WWWWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  ASSERT_TRUE(probes()) << outputs();
  terminal_.type("SS");
  ASSERT_TRUE(touches(false)) << outputs();
  terminal_.type("AAAAAA");
  ASSERT_TRUE(eventually([this] { return lead_m() < 1e-3; })) << outputs();
  terminal_.type("WWWW");  // far behind the face, in free space
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_TRUE(feels(0.0, 0.3)) << outputs();
  EXPECT_FALSE(slave_.status()->in_contact());
}

TEST_F(Person, MovesAndWaitsAtTheMoonAndFeelsTheWall) {
  start({"--profile", "moon", "--set", "link.impairment.rpc_delay_s=0", "--set",
         "scene.surface.wall.plane.point_m=0.03,0,0"},
        "position", {"--profile", "moon"});
  terminal_.type("WWWWWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  EXPECT_TRUE(detects_contact()) << outputs();
}

TEST_F(Person, FeelsAWallInRateMode) {
  start({"--set", "scene.surface.wall.plane.point_m=0.03,0,0"}, "rate");
  const HeldKey held(terminal_.outer);
  terminal_.type("WWWWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  EXPECT_TRUE(detects_contact()) << outputs();
}

TEST_F(Person, FeelsBothSidesOfASlot) {
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "slot.txtpb").string();
  std::ofstream(scene) << "name: 'slot'\n"
                          "material { name: 'm' stiffness_n_per_m: 1000 damping_s_per_m: 0.1 }\n"
                          "surface { name: 'front' material: 'm'\n"
                          "  plane { point_m: [0.02, 0, 0] normal: [-1, 0, 0] } }\n"
                          "surface { name: 'back' material: 'm'\n"
                          "  plane { point_m: [-0.02, 0, 0] normal: [1, 0, 0] } }\n";
  start({"--set", "scene_file=" + scene}, "position");
  terminal_.type("WWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  EXPECT_TRUE(detects_contact(0.4)) << outputs();
  terminal_.type("SSSSSSSSSSSS");
  ASSERT_TRUE(eventually([this] { return tool_x_m() < anchor_m_ - 0.015; })) << outputs();
  ASSERT_TRUE(touches(true)) << outputs();
  EXPECT_TRUE(detects_contact(0.4)) << outputs();
  EXPECT_LT(goal_x_m(), -0.02) << "the hand is pushed back, not pulled in";
  terminal_.type("WWWW");
  ASSERT_TRUE(touches(false)) << outputs();
  EXPECT_TRUE(feels(0.0, 0.3)) << outputs();
}

TEST_F(Person, ANewMasterFeelsWhatTheRobotPressesOn) {
  start({"--set", "scene.surface.wall.plane.point_m=0.01,0,0"}, "position");
  terminal_.type("WWWWWWWWW");
  ASSERT_TRUE(touches(true)) << outputs();
  ASSERT_TRUE(detects_contact()) << outputs();
  master_program_->signal(SIGTERM);
  ASSERT_TRUE(master_program_->wait(std::chrono::seconds(10)).has_value()) << outputs();
  const Terminal another;
  start_master({"--operator", "keyboard", "--mode", "position", "--engage"}, {another.inner, -1, -1});
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_TRUE(detects_contact(0.3)) << outputs();  // it drives a light hand back from home
}

// Free motion zeroes a force sensor whose threshold is derived; status asks for it, and the log keeps it.
TEST_F(Person, ZeroesTheForceSensorByMovingAndTheLogShowsTheZero) {
  start({"--set", "scene.surface.wall.plane.point_m=1,0,0", "--set", "sensing.touch_n=0"}, "rate");
  ASSERT_TRUE(eventually([this] {
    const auto now = slave_.status();
    return now && now->sensor().find("of motion at over 5 mm/s without contact") != std::string::npos;
  })) << outputs();
  EXPECT_EQ(outputs().find("force sensor zero="), std::string::npos) << outputs();
  const HeldKey held(terminal_.outer);
  terminal_.type("WWWWWW");
  ASSERT_TRUE(eventually([this] {
    const auto now = slave_.status();
    return now && now->sensor().find("bias") != std::string::npos;
  })) << outputs();
  EXPECT_TRUE(eventually([this] {
    return outputs().find("force sensor zero=1 bias_n=") != std::string::npos;
  })) << outputs();
}

}  // namespace
}  // namespace longreach::person_test
