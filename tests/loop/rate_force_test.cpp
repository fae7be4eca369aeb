// Rate mode: while the tool presses on a wall, the force at the hand is the ratio `rendering.rate_force_ratio` of the force
// at the tool, and with the handle at home the tool only keeps touching. LONGREACH_FULL: ten seeds instead of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "master/config/rendering_config.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::rate_force_test {
namespace {

struct Held {
  const char* link;
  double wall_n_per_m, hand_m;
  Grip grip;
  std::uint64_t seed;
};

struct HeldSeen {
  double felt_n = 0.0, tool_n = 0.0, swing_n = 0.0;  // while the handle is held deflected
  double home_felt_n = 0.0, home_tool_n = 0.0;       // with the handle at home
  double energy_j = 0.0, past_m = 0.0;
};

/// The handle is held deflected until the tool has pressed for a while, and is then led home.
HeldSeen hold(const Held& c) {
  clocks::Bench bench(
      {std::string("profile=") + c.link, "mapping.mode=RATE", "scene.surface.wall.plane.point_m=0.01,0,0",
       "scene.material.wall.stiffness_n_per_m=" + std::to_string(c.wall_n_per_m)},
      c.seed);
  Laboratory& lab = *bench.lab;
  HandTarget hand;
  hand.grip = c.grip;
  lab.drive(hand);
  clocks::run(lab, 6.0);
  EXPECT_TRUE(clocks::engage(lab, 12.0));
  const double rtt_s = lab.master().rtt_s.value_or(0.0);
  const double begin_s = lab.now_s(), home_s = begin_s + 12.0 + 4.0 * rtt_s,
               end_s = home_s + 6.0 + 3.0 * rtt_s;
  HeldSeen seen;
  double least_n = 1e9, most_n = 0.0;
  while (lab.now_s() < end_s) {
    const double speed_m_per_s = 0.03, since_s = lab.now_s() - begin_s;
    const bool home = lab.now_s() > home_s;
    hand.position_m.x() = home ? std::max(0.0, c.hand_m - speed_m_per_s * (lab.now_s() - home_s))
                               : std::min(c.hand_m, speed_m_per_s * since_s);
    lab.drive(hand);
    lab.step();
    if (!home) seen.past_m = std::max(seen.past_m, -lab.master().p_MH.x());
    const double felt_n = lab.master().spring_force_n.norm(), tool_n = lab.arm().true_wrench().force.norm();
    if (!home) seen.felt_n = felt_n, seen.tool_n = tool_n;
    if (!home && lab.now_s() > home_s - 2.0)
      least_n = std::min(least_n, felt_n), most_n = std::max(most_n, felt_n);
    seen.home_felt_n = felt_n, seen.home_tool_n = tool_n;
  }
  seen.swing_n = most_n - least_n;
  seen.energy_j = lab.master().port_energy_min_j;
  return seen;
}

TEST(RateForce, IsOneRatioOfTheForceAtTheToolAndEndsWithTheHandleAtHome) {
  const RenderingConfig rendering;
  const SensingConfig sensing;
  std::vector<Held> cases;
  for (int seed = 1; seed <= campaign(10, 1); ++seed) {
    for (const char* link : {"lab", "kontur", "gateway", "moon", "etsvii"}) {
      for (const double wall : {200.0, 1000.0, 5000.0}) {
        for (const double hand_m : {0.012, 0.02, 0.045}) {
          for (const Grip grip : {Grip::kLight, Grip::kFirm})
            cases.push_back({link, wall, hand_m, grip, static_cast<std::uint64_t>(seed) + 70});
        }
      }
    }
  }
  std::vector<HeldSeen> held(cases.size());
  on_all_cores(cases.size(), [&](std::size_t i) { held[i] = hold(cases[i]); });
  double least = INFINITY, most = 0.0, home_n = 0.0, swing_n = 0.0, felt_n = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Held& c = cases[i];
    const HeldSeen& s = held[i];
    SCOPED_TRACE(std::string(c.link) + ", " + std::to_string(c.wall_n_per_m) + " N/m, " +
                 (c.grip == Grip::kLight ? "light" : "firm") + ", hand at " + std::to_string(c.hand_m) +
                 " m, seed " + std::to_string(c.seed));
    EXPECT_GT(s.tool_n, 0.3);
    EXPECT_NEAR(s.felt_n, rendering.rate_force_ratio * s.tool_n,
                0.15 * rendering.rate_force_ratio * s.tool_n + 0.01);
    EXPECT_LE(s.swing_n, 0.1);
    EXPECT_LE(s.home_felt_n, 0.02);
    EXPECT_LE(s.home_tool_n, 1.0);
    EXPECT_LE(s.past_m, 2e-4);
    EXPECT_GE(s.energy_j, -returned_most_j());
    least = std::min(least, s.felt_n / s.tool_n);
    most = std::max(most, s.felt_n / s.tool_n);
    home_n = std::max(home_n, s.home_tool_n);
    swing_n = std::max(swing_n, s.swing_n);
    felt_n = std::max(felt_n, s.felt_n);
  }
  std::printf(
      "%zu holds: felt/tool %.3f to %.3f (spread %.2f), at most %.2f N, swing %.3f N; at home the tool at most %.2f N\n",
      cases.size(), least, most, most / least, felt_n, swing_n, home_n);
  EXPECT_LE(most / least, 1.35);
}

}  // namespace
}  // namespace longreach::rate_force_test
