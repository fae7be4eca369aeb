// A SpaceMouse behind a daemon that the test plays.

#include "master/input/space_mouse.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "tests/unit/master/input/fake_daemon.hpp"

namespace longreach::space_mouse_test {
namespace {

struct SpaceMouseTest : ::testing::Test {
  SpaceMouseTest() { ::setenv("SPNAV_SOCKET", path.c_str(), 1); }
  ~SpaceMouseTest() override { ::unsetenv("SPNAV_SOCKET"); }

  /// Polls until it holds; what was told then.
  template <class Holds>
  AxisSample until(SpaceMouse& mouse, const Holds& holds) {
    AxisSample s;
    for (int i = 0; i < 3000; ++i) {
      s = mouse.poll(0.002);
      if (holds(s)) return s;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "it never held";
    return s;
  }
  static bool present(const AxisSample& s) { return s.present; }
  static bool absent(const AxisSample& s) { return !s.present; }

  std::string path =
      (std::filesystem::temp_directory_path() / ("longreach-spnav-" + std::to_string(::getpid()))).string();
};

TEST_F(SpaceMouseTest, ThePuckIsTheHand) {
  SpaceMouse mouse;
  FakeDaemon daemon(path);
  until(mouse, present);
  daemon.motion({0, 0, -350, 0, 0, 0});  // pushed away
  AxisSample s = until(mouse, [](const AxisSample& now) { return now.push.x() > 0.5; });
  EXPECT_LT((s.push - Vector3(1, 0, 0)).norm(), 1e-9);
  daemon.motion({-175, 350, 0, 0, 70, 0});  // left, up, turned about the upright
  s = until(mouse, [](const AxisSample& now) { return now.push.z() > 0.5; });
  EXPECT_LT((s.push - Vector3(0, 0.5, 1)).norm(), 1e-9);
  EXPECT_LT((s.twist - Vector3(0, 0, 0.2)).norm(), 1e-9);
  daemon.button(1, true);
  until(mouse,
        [](const AxisSample& now) { return now.buttons == 1U << static_cast<unsigned>(PadButton::kStop); });
  daemon.button(1, false);
  until(mouse, [](const AxisSample& now) { return now.buttons == 0; });
}

TEST_F(SpaceMouseTest, ADaemonThatEndsIsADeviceThatIsLostAndFoundAgain) {
  SpaceMouse mouse;
  EXPECT_FALSE(mouse.poll(0.02).present);
  {
    FakeDaemon daemon(path);
    until(mouse, present);
    daemon.motion({0, 0, -350, 0, 0, 0});
    until(mouse, [](const AxisSample& s) { return s.push.x() > 0.5; });
  }
  const AxisSample gone = until(mouse, absent);
  EXPECT_EQ(gone.push, Vector3::Zero());
  FakeDaemon again(path);
  EXPECT_EQ(until(mouse, present).push, Vector3::Zero());
}

TEST_F(SpaceMouseTest, ADeviceThatIsUnpluggedIsLostThoughTheDaemonRuns) {
  SpaceMouse mouse;
  FakeDaemon daemon(path);
  until(mouse, present);
  daemon.motion({0, 0, -350, 0, 0, 0});
  until(mouse, [](const AxisSample& s) { return s.push.x() > 0.5; });
  daemon.unplugged();
  EXPECT_EQ(until(mouse, absent).push, Vector3::Zero());
  daemon.plugged_in();
  EXPECT_EQ(until(mouse, present).push, Vector3::Zero());
}

TEST_F(SpaceMouseTest, CountsItsReportsAlsoEqualOnes) {
  SpaceMouse mouse;
  FakeDaemon daemon(path);
  until(mouse, present);
  daemon.motion({0, 0, -350, 0, 0, 0});
  until(mouse, [](const AxisSample& s) { return s.push.x() > 0.5; });
  const std::uint32_t reports = mouse.poll(0.5).reports;
  EXPECT_EQ(mouse.poll(0.5).reports, reports);
  daemon.motion({0, 0, -350, 0, 0, 0});
  until(mouse, [=](const AxisSample& s) { return s.reports == reports + 1; });
}

}  // namespace
}  // namespace longreach::space_mouse_test
