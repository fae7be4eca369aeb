// A person at the keyboard of the real programs touches a wall that nothing has announced and then rests: what the hand
// feels is what the tool presses.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <thread>

#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"

namespace longreach {
namespace {

class RestingTouches : public Station {
 protected:
  void touch(const std::string& profile, double n_per_m, const std::vector<std::string>& more = {}) {
    terminal_.emplace();
    start_slave({"--profile", profile, "--set", "link.impairment.rpc_delay_s=0", "--set",
                 "scene.surface.wall.plane.point_m=0.02,0,0", "--set",
                 "scene.material.wall.stiffness_n_per_m=" + std::to_string(n_per_m)});
    std::vector<std::string> master{"--operator", "keyboard", "--engage",      "--profile",
                                    profile,      "--set",    "hand.grip=FIRM"};
    master.insert(master.end(), more.begin(), more.end());
    start_master(master, {terminal_->inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
    terminal_->type("WWWWWWWWWW");  // 50 mm: 25 mm behind the wall
  }
  double felt_n() { return master_.status() ? master_.status()->contact_n() : 0.0; }
  /// The force that the tool presses with, at the hand.
  double pressed_n() {
    const auto now = slave_.status();
    return now ? now->force_n() / kScale : 0.0;
  }
  static constexpr double kScale = 0.8;  // the default of mapping.scale
  std::optional<Terminal> terminal_{};
};

TEST_F(RestingTouches, AreFeltAsTheToolPresses) {
  for (const auto& [profile, n_per_m] : {std::pair{"lab", 300.0}, {"lab", 1000.0}, {"moon", 1000.0}}) {
    touch(profile, n_per_m);
    const auto agree = [this] {
      const double felt = felt_n(), pressed = pressed_n();
      return felt >= 1.0 && std::abs(felt - pressed) < 0.2 * pressed;
    };
    EXPECT_TRUE(eventually(agree)) << felt_n() << " and " << pressed_n() << " N\n" << outputs();
    std::this_thread::sleep_for(std::chrono::seconds(3));
    EXPECT_TRUE(agree()) << "it stays so";
    std::printf("%s, %.0f N/m: felt %.2f N, pressed %.2f N at the hand\n", profile, n_per_m, felt_n(),
                pressed_n());
    const auto clamped = master_.status().value_or(proto::Status{}).clamped();
    EXPECT_TRUE(std::ranges::any_of(
        clamped, [](const std::string& words) { return words.find("goal: moved out by") == 0; }));
    master_program_.reset();
    slave_program_.reset();
  }
}

TEST_F(RestingTouches, AreFeltLessWhereTheGoalStays) {
  touch("lab", 1000.0, {"--set", "mapping.goal_follows_force=false"});
  EXPECT_TRUE(eventually([this] { return felt_n() > 0.5; })) << outputs();
  std::this_thread::sleep_for(std::chrono::seconds(5));
  EXPECT_LT(felt_n(), 0.5 * pressed_n());
}

}  // namespace
}  // namespace longreach
