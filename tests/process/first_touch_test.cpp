// A person at the keyboard of the real programs touches a wall that nothing has announced, at several speeds in both
// modes. LONGREACH_FULL: the whole grid of stiffnesses and speeds; otherwise the stiffest wall at two speeds.
#include <algorithm>
#include <cstdio>

#include "deploy/lab/campaign_size.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"

namespace longreach::first_touch_test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kGuard_n = 20.0, kOvershoot = 1.35, kWall_m = 0.03;

class FirstTouches : public Station {
 protected:
  /// Returns the largest force until two seconds after the touch. The goal moves at `m_per_s`.
  double largest_force_n(const std::string& mode, double n_per_m, double m_per_s) {
    const Terminal terminal;
    start_slave({"--set", "scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0", "--set",
                 "scene.material.wall.stiffness_n_per_m=" + std::to_string(n_per_m)});
    start_master({"--operator", "keyboard", "--mode", mode, "--engage", "--set", "hand.grip=FIRM", "--set",
                  "mapping.scale=1", "--set", "mapping.kv_per_s=10", "--set",
                  "mapping.speed_max_m_per_s=" + std::to_string(m_per_s)},
                 {terminal.inner, -1, -1});
    EXPECT_TRUE(both_engaged()) << outputs();
    terminal.type("WWWWWWWWWWWW");
    double largest_n = 0.0;
    const auto touches = [&] {
      const auto now = slave_.status();
      if (now) largest_n = std::max(largest_n, now->force_n());
      return now && now->in_contact();
    };
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (!touches() && Clock::now() < end) continue;
    EXPECT_TRUE(slave_.status()->in_contact()) << outputs();
    for (const auto last = Clock::now() + std::chrono::seconds(2); Clock::now() < last;) (void)touches();
    std::printf("first touch, %s mode, %.0f N/m, goal at %.0f mm/s: at most %.1f N\n", mode.c_str(), n_per_m,
                1e3 * m_per_s, largest_n);
    master_program_.reset();
    slave_program_.reset();
    return largest_n;
  }
};

TEST_F(FirstTouches, ByKeysStayWithinTheGuardAtEverySpeed) {
  const bool full = campaign(1, 0) == 1;
  for (const std::string mode : {"position", "rate"}) {
    for (const double n_per_m : full ? std::vector{5e3, 1e4, 2e4} : std::vector{2e4}) {
      for (const double m_per_s : full ? std::vector{0.025, 0.05, 0.08, 0.15} : std::vector{0.05, 0.15}) {
        EXPECT_LT(largest_force_n(mode, n_per_m, m_per_s), kOvershoot * kGuard_n);
      }
    }
  }
}

}  // namespace
}  // namespace longreach::first_touch_test
