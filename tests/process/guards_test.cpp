// The guards of force and moment of the real programs: a wall that comes while a person holds the keyboard's
// handle still, and who then retreats; a stop that is turned against. No keyboard turns: that is a
// SpaceMouse.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/unit/master/input/fake_daemon.hpp"

namespace longreach::guards_test {
namespace {

class Guards : public Station {
 protected:
  double tool_x_m() {
    const auto now = slave_.status();
    return now && now->tool_m_size() == 3 ? now->tool_m(0) : NAN;
  }
  bool clamped(const std::string& what) {
    const auto now = slave_.status();
    return now && std::ranges::find(now->clamped(), what) != now->clamped().end();
  }
};

// The wall touches 15 s after the slave has started.
TEST_F(Guards, GiveWayToAWallThatComesAndTheOperatorRetreats) {
  constexpr double kGuard_n = 20.0, kGiveWay_m = 0.05;
  const Terminal terminal;
  start_slave({"--set", "scene.surface.wall.plane.point_m=0.45,0,0", "--set",
               "scene.surface.wall.movement.velocity_m_per_s=-0.03,0,0", "--set",
               "command.give_way_m=" + std::to_string(kGiveWay_m)});
  start_master({"--operator", "keyboard", "--mode", "position", "--engage"}, {terminal.inner, -1, -1});
  ASSERT_TRUE(both_engaged()) << outputs();
  const double from_m = tool_x_m();
  double most_n = 0.0;
  ASSERT_TRUE(eventually([&] {
    const auto now = slave_.status();
    if (now && now->state() == "Engaged") most_n = std::max(most_n, now->force_n());
    return now && now->state() == "Holding";
  })) << outputs();
  EXPECT_EQ(slave_.status()->cause(), "surface approaching") << outputs();
  EXPECT_GT(most_n, 0.5 * kGuard_n);
  EXPECT_LT(most_n, 1.35 * kGuard_n);
  EXPECT_NEAR(tool_x_m(), from_m - kGiveWay_m, 0.01);
  EXPECT_TRUE(eventually([this] { return master_.status()->cause() == "surface approaching"; })) << outputs();
  const double held_m = tool_x_m();
  terminal.type("e");
  ASSERT_TRUE(both_engaged()) << outputs();
  terminal.type("SSSSSSSS");
  EXPECT_TRUE(eventually([&] { return tool_x_m() < held_m - 0.02; })) << outputs();
}

TEST_F(Guards, MomentGuardHoldsAtStiffStopAndAllowsRetreat) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("longreach-guards-" + std::to_string(::getpid()))).string();
  ::setenv("SPNAV_SOCKET", path.c_str(), 1);
  FakeDaemon daemon(path);
  start_slave(
      {"--set", "scene_file=scenes/hinge.txtpb", "--set", "scene.material.stop.stiffness_n_per_m=100000"});
  // Else the deflection commands the moment as soon as the stop is known, and the guard has nothing to do.
  start_master({"--operator", "spacemouse", "--mode", "rate", "--set", "rendering.rate_force_ratio=0"});
  ASSERT_TRUE(engaged()) << outputs();
  const auto turns = [&](int deflection, bool guarded) {
    return eventually([&, guarded] {
      daemon.push({0, 0, 0, 0, deflection, 0});
      return clamped("moment guard") == guarded && slave_.status()->in_contact() == guarded;
    });
  };
  EXPECT_TRUE(turns(350, true)) << outputs();
  EXPECT_EQ(slave_.state(), "Engaged") << outputs();
  EXPECT_TRUE(turns(-350, false)) << outputs();
  ::unsetenv("SPNAV_SOCKET");
}

}  // namespace
}  // namespace longreach::guards_test
