// A hand at the master that may be gone: a SpaceMouse, whose daemon the test plays; a keyboard whose input
// ends.

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "common/spatial/spatial.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/unit/master/input/fake_daemon.hpp"

namespace longreach::hand_test {
namespace {

class Hands : public Station {
 protected:
  Hands() { ::setenv("SPNAV_SOCKET", path_.c_str(), 1); }
  ~Hands() override { ::unsetenv("SPNAV_SOCKET"); }

  double tool_x() {
    const auto s = slave_.status();
    return s && s->tool_m_size() == 3 ? s->tool_m(0) : NAN;
  }

  std::string path_ =
      (std::filesystem::temp_directory_path() / ("longreach-hands-" + std::to_string(::getpid()))).string();
};

TEST_F(Hands, ASpaceMouseMovesTheRobotAndIsAHoldWhenItIsUnplugged) {
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master({"--operator", "spacemouse", "--mode", "rate"});
  ASSERT_TRUE(says(*master_program_, "no SpaceMouse found; plug it in and start spacenavd, then engage"))
      << outputs();
  EXPECT_TRUE(eventually([this] { return master_.engage().find("plug it in") != std::string::npos; }));

  FakeDaemon daemon(path_);
  ASSERT_TRUE(engaged()) << outputs();
  // Pushed away: the robot moves along x as long as news of it come.
  const double began_m = tool_x();
  ASSERT_TRUE(eventually([&] {
    daemon.push({0, 0, -350, 0, 0, 0});
    return tool_x() > began_m + 0.01;
  })) << outputs();

  daemon.unplugged();
  ASSERT_TRUE(eventually([this] { return master_.state() == "Fault" && slave_.state() == "Holding"; }))
      << outputs();
  EXPECT_EQ(master_.status()->cause(), "device fault");
  double rest_m = tool_x();
  ASSERT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double now_m = tool_x();
    return std::abs(now_m - std::exchange(rest_m, now_m)) < 1e-6;
  }));
  // Plugged in again while it is pushed: nothing, also when it is engaged, before it was let go of.
  daemon.plugged_in();
  ASSERT_TRUE(eventually([&] {
    daemon.motion({0, 0, -350, 0, 0, 0});
    return master_program_->output().find("the puck is not centred; release it once") != std::string::npos;
  })) << outputs();
  daemon.motion({0, 0, 0, 0, 0, 0});
  ASSERT_TRUE(engaged()) << outputs();
  EXPECT_NEAR(tool_x(), rest_m, 1e-4);
}

/// Moves the robot by the keyboard in rate mode; how the input ends is the test's.
class Keys : public Hands {
 protected:
  void move(int in, int typist, const std::vector<std::string>& more = {}) {
    start_slave({"--set", "scene_file=scenes/free.txtpb"});
    std::vector<std::string> options{"--operator", "keyboard", "--mode", "rate"};
    options.insert(options.end(), more.begin(), more.end());
    start_master(options, {.in = in});
    ASSERT_TRUE(engaged()) << outputs();
    const double began_m = tool_x();
    ASSERT_EQ(::write(typist, "WWWWW", 5), 5);
    const HeldKey held(typist);
    ASSERT_TRUE(eventually([&] { return tool_x() > began_m + 0.01; })) << outputs();
  }
  void start_anew(const std::vector<std::string>& master, int in) {
    master_program_.reset();
    slave_program_.reset();
    start_slave();
    start_master(master, {.in = in});
  }
  void expect_rest(const std::string& why) {
    ASSERT_TRUE(says(*master_program_, why)) << outputs();
    ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs();
    EXPECT_NE(master_.engage().find(why), std::string::npos);
    EXPECT_TRUE(rests()) << outputs();
  }
  bool rests() {
    double last_m = tool_x();
    return eventually([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      const double now_m = tool_x();
      return std::abs(now_m - std::exchange(last_m, now_m)) < 1e-6;
    });
  }
};

TEST_F(Keys, APipeThatEndsIsAHandThatLetsGo) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  move(ends[0], ends[1]);
  ::close(ends[1]);
  expect_rest("the keyboard input ended (end of input)");
  ::close(ends[0]);
}

TEST_F(Keys, AClosedTerminalIsAHandThatLetsGo) {
  int outer = -1, inner = -1;
  ASSERT_EQ(::openpty(&outer, &inner, nullptr, nullptr, nullptr), 0);
  ::fcntl(outer, F_SETFD, FD_CLOEXEC);
  move(inner, outer, {"--set", "safety.presence=HOLD"});
  ::close(outer);
  expect_rest("the keyboard input ended (its terminal was closed)");
  ::close(inner);
}

// A terminal reports no release of a key; what feeds a pipe may be suspended.
TEST_F(Keys, ThatComeNoMoreInRateModeLeaveTheRobotAtRest) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  move(ends[0], ends[1]);
  ASSERT_TRUE(says(*master_program_, "the hand returned to its home position")) << outputs();
  ASSERT_TRUE(rests()) << outputs();
  EXPECT_EQ(master_.state(), "Engaged");
  ::close(ends[0]);
  ::close(ends[1]);
}

// The friction of the handle leaves it about 5 % behind the hand.
TEST_F(Keys, TurnTheTool) {
  const Terminal terminal;
  start_slave();
  start_master({"--operator", "keyboard", "--engage", "--mode", "position", "--set", "mapping.scale=1"},
               {.in = terminal.inner});
  ASSERT_TRUE(engaged()) << outputs();
  const auto turned_rad = [this] {
    const recording::SlaveView view = slave_.status().value_or(proto::Status{}).slave_view();
    const auto of = [](const auto& pose) {
      const auto& q = pose.orientation();
      return Quaternion(q.w(), q.x(), q.y(), q.z());
    };
    return log_rotation(of(view.tool()) * of(view.anchor()).conjugate());
  };
  const auto turns = [&](const Vector3& to_rad) {
    return eventually([&] { return (turned_rad() - to_rad).norm() < 0.08 * to_rad.norm(); });
  };
  terminal.type("JJJJ");  // 0.2 rad about z
  EXPECT_TRUE(turns({0.0, 0.0, 0.2})) << turned_rad().transpose() << outputs();
  terminal.type(" UUUU");
  EXPECT_TRUE(turns({0.2, 0.0, 0.0})) << turned_rad().transpose() << outputs();
}

// Each key changes kv by a factor of 1.25; the hand stays deflected.
TEST_F(Keys, ChangeTheSpeedPerDeflectionInMotion) {
  const Terminal terminal;
  move(terminal.inner, terminal.outer);
  const HeldKey held(terminal.outer);
  const auto kv_per_s = [this] { return master_.status()->master_view().kv_per_s(); };
  const auto speed_m_per_s = [this] {
    const double from_m = master_.status()->goal_m(0);
    const Time from = boottime_now();
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    const double to_m = master_.status()->goal_m(0);
    return (to_m - from_m) / to_seconds(boottime_now() - from);
  };
  EXPECT_EQ(kv_per_s(), 2.0);
  const double before = speed_m_per_s();
  EXPECT_GT(before, 0.0);
  terminal.type(",,,,,");
  ASSERT_TRUE(eventually([&] { return std::abs(kv_per_s() - 2.0 / std::pow(1.25, 5)) < 1e-9; })) << outputs();
  std::this_thread::sleep_for(std::chrono::milliseconds(700));  // the ramp
  EXPECT_NEAR(speed_m_per_s(), before / std::pow(1.25, 5), 0.15 * before);
  terminal.type("...");
  EXPECT_TRUE(eventually([&] { return std::abs(kv_per_s() - 2.0 / std::pow(1.25, 2)) < 1e-9; })) << outputs();
  EXPECT_EQ(master_.state(), "Engaged");
}

TEST_F(Keys, BringTheHandleHomeBeforeRateModeMovesTheRobot) {
  const Terminal terminal;
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master({"--operator", "keyboard", "--engage", "--mode", "position"}, {.in = terminal.inner});
  ASSERT_TRUE(engaged()) << outputs();
  const double began_m = tool_x();
  terminal.type("WWWW");  // 20 mm
  ASSERT_TRUE(eventually([&] { return tool_x() > began_m + 0.014; })) << outputs();
  ASSERT_TRUE(rests()) << outputs();
  const HeldKey held(terminal.outer);
  terminal.type("m");
  const auto situation = [this] { return master_.status()->situation(); };
  ASSERT_TRUE(eventually([&] { return situation() == "bring the handle home"; })) << outputs();
  EXPECT_TRUE(says(*master_program_, "bring the handle home")) << outputs();
  const double rest_m = tool_x();
  terminal.type("WW");
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_NEAR(tool_x(), rest_m, 1e-4);
  terminal.type(" ");
  ASSERT_TRUE(eventually([&] { return situation() == "free motion"; })) << outputs();
  EXPECT_NEAR(tool_x(), rest_m, 1e-4);
  terminal.type("WW");
  EXPECT_TRUE(eventually([&] { return tool_x() > rest_m + 0.005; })) << outputs();
}

TEST_F(Keys, StopWithinTextThatATerminalNeverEnds) {
  for (const std::string text : {"\x1b]11;rgb:ee", "\x1b[200~hello", "\x9d"}) {
    const Terminal terminal;
    start_anew({"--operator", "keyboard", "--engage"}, terminal.inner);
    ASSERT_TRUE(engaged()) << outputs();
    terminal.paste(text);
    EXPECT_TRUE(eventually([&] {
      terminal.type("x");
      return master_.state() == "Stopped";
    })) << testing::PrintToString(text)
        << outputs();
  }
}

TEST_F(Keys, DoNotEngageOutOfAPasteThatStalls) {
  const Terminal terminal;
  start_slave();
  start_master({"--operator", "keyboard", "--mode", "position"}, {.in = terminal.inner});
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; })) << outputs();
  terminal.paste("\x1b[200~hello ");
  ASSERT_TRUE(says(*master_program_, "a paste or control sequence from the keyboard is incomplete"))
      << outputs();
  terminal.paste("e m W q\n\x1b[201~");
  terminal.type("m");
  ASSERT_TRUE(eventually([this] { return master_.status()->mode() != "position"; })) << outputs();
  EXPECT_EQ(master_.state(), "Observing");
  EXPECT_TRUE(master_program_->running());
}

TEST_F(Keys, WithoutInputAtTheStartAreSaidToBeMissing) {
  for (const int in : {-1, Streams::kClosed}) {  // -1: /dev/null
    start_anew({"--operator", "keyboard", "--engage"}, in);
    ASSERT_TRUE(says(*master_program_, "no keyboard is available (end of input)")) << outputs();
    EXPECT_TRUE(eventually(
        [this] { return master_.engage().find("no keyboard is available") != std::string::npos; }));
  }
}

}  // namespace
}  // namespace longreach::hand_test
