// A person at the keyboard of the real programs touches a wall that nothing has announced and then rests: what the hand
// feels is what the tool presses.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>

#include "common/recording/mcap_reader.hpp"
#include "common/spatial/spatial.hpp"
#include "proto/recording.pb.h"
#include "tests/process/load.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::resting_touch_test {
namespace {

class RestingTouches : public Station {
 protected:
  void start(const std::string& profile, double n_per_m, const std::vector<std::string>& more = {},
             const std::vector<std::string>& scene = {}) {
    terminal_.emplace();
    std::vector<std::string> slave{
        "--profile", profile,
        "--set",     "link.impairment.rpc_delay_s=0",
        "--set",     "scene.surface.wall.plane.point_m=0.02,0,0",
        "--set",     "scene.material.wall.stiffness_n_per_m=" + std::to_string(n_per_m)};
    slave.insert(slave.end(), scene.begin(), scene.end());
    start_slave(slave);
    std::vector<std::string> master{"--operator", "keyboard", "--engage",      "--profile",
                                    profile,      "--set",    "hand.grip=FIRM"};
    master.insert(master.end(), more.begin(), more.end());
    start_master(master, {terminal_->inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
  }
  void touch(const std::string& profile, double n_per_m, const std::vector<std::string>& more = {}) {
    start(profile, n_per_m, more);
    terminal_->type("WWWWWWWWWW");  // 50 mm: 25 mm behind the wall
  }
  void end() {
    master_program_.reset();
    slave_program_.reset();
  }
  double tool_n() { return slave_.status() ? slave_.status()->force_n() : 0.0; }
  /// Returns whether the force at the hand comes to within 20 % of `ratio` times that at the tool, at least `least_n`, and
  /// stays so. Both are means over one second: a single force of the sensor has a noise of 0.05 to 0.1 N.
  bool agree(double ratio, double least_n) {
    const auto now = [&] {
      constexpr int kCount = 40;
      double felt = 0.0, due = 0.0;
      for (int i = 0; i < kCount; ++i) {
        felt += felt_n() / kCount;
        due += ratio * tool_n() / kCount;
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
      }
      std::printf("felt %.2f N, due %.2f N\n", felt, due);
      return felt >= least_n && std::abs(felt - due) < 0.2 * due + 0.05;
    };
    if (!eventually(now)) return false;
    std::this_thread::sleep_for(std::chrono::seconds(2));
    return now();
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
    EXPECT_TRUE(agree(1.0 / kScale, 1.0)) << profile << ", " << n_per_m << " N/m\n" << outputs();
    const auto clamped = master_.status().value_or(proto::Status{}).clamped();
    EXPECT_TRUE(std::ranges::any_of(
        clamped, [](const std::string& words) { return words.find("goal: moved out by") == 0; }));
    end();
  }
}

TEST_F(RestingTouches, AreFeltOnSoftWallsAfterALightTouch) {
  for (const double n_per_m : {200.0, 400.0}) {
    // A machine that stands still during the touch leaves too few samples of it.
    for (int tries = 3; tries > 0; --tries) {
      BareLoops machine;
      start("lab", n_per_m);
      terminal_->type(n_per_m < 300.0 ? "WWWWWwwwwww" : "WWWWWwww");  // 6 or 3 mm behind the wall: about 1 N
      const bool felt = agree(1.0 / kScale, 0.2);
      EXPECT_TRUE(felt || (machine.end().stalls > 0 && tries > 1)) << outputs();
      end();
      if (felt) break;
    }
  }
}

TEST_F(RestingTouches, AreFeltByOneRatioInRateModeAndEndWithTheHandleAtHome) {
  start("lab", 1000.0, {"--mode", "rate"});
  {
    const HeldKey held(terminal_->outer);
    terminal_->type("WWWW");
    EXPECT_TRUE(agree(0.1, 0.5)) << outputs();
  }
  terminal_->type(" ");
  const double kept_n = 1.0;  // twice the touch threshold
  EXPECT_TRUE(eventually([&] { return tool_n() < kept_n && felt_n() < 0.05; })) << outputs();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_LT(tool_n(), kept_n);
  EXPECT_TRUE(slave_.status()->in_contact()) << outputs();
}

TEST_F(RestingTouches, AreFeltOfAWallThatComes) {
  start("lab", 1000.0, {},
        {"--set", "scene.surface.wall.plane.point_m=0.04,0,0", "--set",
         "scene.surface.wall.movement.velocity_m_per_s=-0.002,0,0"});
  ASSERT_TRUE(eventually([this] { return felt_n() > 1.0; })) << outputs();
  const double pressed_n = tool_n();
  std::printf("a wall that approaches at 2 mm/s is felt when it presses with %.1f N\n", pressed_n);
  EXPECT_LT(pressed_n, 8.0) << outputs();
}

TEST_F(RestingTouches, AreFeltAsTheToolPressesAtAnotherScale) {
  touch("lab", 1000.0);
  ASSERT_TRUE(agree(1.0 / kScale, 1.0)) << outputs();
  terminal_->type("----------");  // to 0.3
  EXPECT_TRUE(eventually([this] { return std::abs(master_.status()->scale() - 0.3) < 1e-6; })) << outputs();
  EXPECT_TRUE(agree(1.0 / 0.3, 1.0)) << outputs();
}

/// The largest change of the force on the hand in 1 ms of a recording, beyond what the motion of the handle changes: at
/// a surface 1.2 k |v| T, and by the drag on a hand that is freed b |dv|. The measured velocity of a handle with encoders
/// leaps at each count. A tick that is late has the change of several, and the next one that of a whole one.
double largest_step_n(const std::filesystem::path& recording, double n_per_m) {
  struct Seen {
    Vector3 force_n, at_m, moved_m;  // moved: in 1 ms
    double ms;
  };
  constexpr double kDrag_n_s_per_m = 30.0 + 2.0;  // of a freed hand, and that which refills the store
  McapReader reader(recording);
  double out = 0.0;
  std::optional<Seen> before;
  const auto vector = [](const recording::Vector& v) { return Vector3(v.x(), v.y(), v.z()); };
  while (const auto message = reader.next()) {
    if (message->channel->topic != "/master/tick") continue;
    recording::MasterTick tick;
    EXPECT_TRUE(tick.ParseFromArray(message->bytes.data(), static_cast<int>(message->bytes.size())));
    const Seen now{vector(tick.output().wrench().force_n()), vector(tick.input().handle().position_m()),
                   1e-3 * vector(tick.input().handle().velocity_m_per_s()),
                   1e-6 * static_cast<double>(tick.input().now_ns())};
    if (before) {
      const double by_motion_n =
          1.2 * n_per_m * std::max((now.at_m - before->at_m).norm(), now.moved_m.norm()) +
          kDrag_n_s_per_m * 1e3 * (now.moved_m - before->moved_m).norm();
      out = std::max(out, ((now.force_n - before->force_n).norm() - by_motion_n) /
                              std::max(1.0, std::round(now.ms - before->ms)));
    }
    before = now;
  }
  return out;
}

TEST_F(RestingTouches, EndByARampWhateverEndsThem) {
  const TemporaryFolder folder;
  const struct {
    const char* name;
    const char* keys;
    double rest;  // at most so much of the force is left
  } kEndings[] = {{"clutch", "c", 0.05},
                  {"mode", "m", 0.2},
                  {"stop", "x", 0.05},
                  {"engaged in a hold", "xe", 1.1},
                  {"scale", "++++++++++++++", 0.9}};
  for (const auto& [name, keys, rest] : kEndings) {
    const std::string file = (folder.path() / (std::string(name) + ".mcap")).string();
    touch("lab", 1000.0, {"--record", file});
    ASSERT_TRUE(eventually([this] { return felt_n() > 2.0; })) << name << outputs();
    terminal_->type("----------");  // to 0.3
    ASSERT_TRUE(agree(1.0 / 0.3, 2.0)) << name << outputs();
    const double before_n = felt_n();
    terminal_->type(keys);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    const double after_n = felt_n();
    terminal_->type("q");
    EXPECT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << name << outputs();
    const double step_n = largest_step_n(file, 1000.0);
    std::printf("%s: felt %.2f N before and %.2f N after, steps of at most %.3f N\n", name, before_n, after_n,
                step_n);
    EXPECT_LE(after_n, rest * before_n) << name;
    EXPECT_LE(step_n, 0.3 + 2e-3) << name;
    end();
  }
}

TEST_F(RestingTouches, AreFeltLessWhereTheGoalStays) {
  touch("lab", 1000.0, {"--set", "mapping.goal_follows_force=false"});
  EXPECT_TRUE(eventually([this] { return felt_n() > 0.5; })) << outputs();
  std::this_thread::sleep_for(std::chrono::seconds(5));
  EXPECT_LT(felt_n(), 0.5 * pressed_n());
}

}  // namespace
}  // namespace longreach::resting_touch_test
