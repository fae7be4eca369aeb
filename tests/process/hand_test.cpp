// A hand at the master that may be gone: a SpaceMouse, whose daemon the test plays; a keyboard whose input
// ends.

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "tests/process/station.hpp"
#include "tests/unit/drivers/fake_daemon.hpp"

namespace longreach {
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
  ASSERT_TRUE(says(*master_program_, "no SpaceMouse is there; plug it in and start spacenavd, then engage"))
      << outputs();
  EXPECT_TRUE(eventually([this] { return master_.engage().find("plug it in") != std::string::npos; }));

  FakeDaemon daemon(path_);
  ASSERT_TRUE(engaged()) << outputs();
  // Pushed away: the robot moves along x as long as news of it come.
  const double began_m = tool_x();
  ASSERT_TRUE(eventually([&] {
    daemon.motion({0, 0, -350, 0, 0, 0});
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
  daemon.motion({0, 0, -350, 0, 0, 0});
  ASSERT_TRUE(says(*master_program_, "the puck is not at rest; let go of it once")) << outputs();
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
    ASSERT_TRUE(eventually([&] { return tool_x() > began_m + 0.01; })) << outputs();
  }
  void expect_rest(const std::string& why) {
    ASSERT_TRUE(says(*master_program_, why)) << outputs();
    ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs();
    EXPECT_NE(master_.engage().find(why), std::string::npos);
    double last_m = tool_x();
    EXPECT_TRUE(eventually([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      const double now_m = tool_x();
      return std::abs(now_m - std::exchange(last_m, now_m)) < 1e-6;
    })) << outputs();
  }
};

TEST_F(Keys, APipeThatEndsIsAHandThatLetsGo) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  move(ends[0], ends[1]);
  ::close(ends[1]);
  expect_rest("the keyboard has ended (end of input)");
  ::close(ends[0]);
}

TEST_F(Keys, AClosedTerminalIsAHandThatLetsGo) {
  int outer = -1, inner = -1;
  ASSERT_EQ(::openpty(&outer, &inner, nullptr, nullptr, nullptr), 0);
  ::fcntl(outer, F_SETFD, FD_CLOEXEC);
  move(inner, outer, {"--set", "safety.presence=HOLD"});
  ::close(outer);
  expect_rest("the keyboard has ended (its terminal was closed)");
  ::close(inner);
}

TEST_F(Keys, WithoutInputAtTheStartAreSaidToBeMissing) {
  start_slave();
  start_master({"--operator", "keyboard", "--engage"});  // its input is /dev/null
  ASSERT_TRUE(says(*master_program_, "no keyboard is there (end of input)")) << outputs();
  EXPECT_TRUE(
      eventually([this] { return master_.engage().find("no keyboard is there") != std::string::npos; }));
}

}  // namespace
}  // namespace longreach
