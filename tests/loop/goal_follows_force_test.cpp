// A hand rests after a first touch: what it feels is what the tool presses, because the goal moves out of the wall as far
// as the spring at the hand cannot carry it. LONGREACH_FULL: ten seeds instead of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::goal_follows_force_test {
namespace {

struct Touched {
  double felt_n = 0.0, tool_n = 0.0, swing_n = 0.0, energy_j = 0.0;
  double differs_s =
      0.0;  // how long after the first report of the resting hand's surface they last differed by 20 %
};

/// The hand moves 30 mm behind the surface at `m_per_s`, and rests for 15 s and three round trips.
Touched touch(const std::string& link, double wall_n_per_m, Grip grip, double m_per_s, std::uint64_t seed) {
  constexpr double kWall_m = 0.02, kScale = 0.8;
  clocks::Bench bench({"profile=" + link, "mapping.mode=POSITION", "mapping.scale=" + std::to_string(kScale),
                       "scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0",
                       "scene.material.wall.stiffness_n_per_m=" + std::to_string(wall_n_per_m)},
                      seed);
  Laboratory& lab = *bench.lab;
  HandTarget hand;
  hand.grip = grip;
  lab.drive(hand);
  clocks::run(lab, 6.0);
  EXPECT_TRUE(clocks::engage(lab, 12.0));
  const double deepest_m = kWall_m / kScale + 0.03, begin_s = lab.now_s();
  const double rests_s = begin_s + deepest_m / m_per_s + 15.0 + 3.0 * lab.master().rtt_s.value_or(0.0);
  Touched seen;
  double least_n = 1e9, most_n = 0.0, known_s = 0.0;
  std::vector<double> felt_n, tool_n;
  while (lab.now_s() < rests_s) {
    hand.position_m.x() = std::min(deepest_m, (lab.now_s() - begin_s) * m_per_s);
    lab.drive(hand);
    lab.step();
    felt_n.push_back(lab.master().spring_force_n.norm());
    tool_n.push_back(lab.arm().true_wrench().force.norm() / kScale);
    if (!lab.master().surface_known || lab.now_s() < begin_s + deepest_m / m_per_s) known_s = lab.now_s();
    if (lab.now_s() < rests_s - 2.0) continue;
    least_n = std::min(least_n, lab.master().spring_force_n.norm());
    most_n = std::max(most_n, lab.master().spring_force_n.norm());
  }
  const auto delay = static_cast<std::size_t>(0.5e3 * lab.master().rtt_s.value_or(0.0));
  for (std::size_t i = 0; i + delay < felt_n.size(); ++i)
    if (std::abs(felt_n[i] - tool_n[i + delay]) > 0.2 * tool_n[i + delay])
      seen.differs_s = begin_s + 1e-3 * static_cast<double>(i) - known_s;
  seen.felt_n = lab.master().spring_force_n.norm();
  seen.tool_n = lab.arm().true_wrench().force.norm();
  seen.swing_n = most_n - least_n;
  seen.energy_j = lab.master().port_energy_min_j;
  return seen;
}

TEST(GoalFollowsForce, WhatARestingHandFeelsIsWhatTheToolPresses) {
  constexpr double kScale = 0.8, kAgree_s = 1.5;
  const std::vector<const char*> links{"lab", "kontur", "gateway", "moon", "etsvii"};
  struct Case {
    const char* link;
    double wall_n_per_m, m_per_s;
    Grip grip;
    std::uint64_t seed;
  };
  std::vector<Case> cases;
  for (int seed = 1; seed <= campaign(10, 1); ++seed) {
    for (const char* link : links) {
      for (const double wall : {200.0, 400.0, 1000.0, 5000.0}) {
        for (const double m_per_s : {0.03, 0.2}) {
          for (const Grip grip : {Grip::kLight, Grip::kFirm})
            cases.push_back({link, wall, m_per_s, grip, static_cast<std::uint64_t>(seed) + 200});
        }
      }
    }
  }
  std::vector<Touched> touched(cases.size());
  on_all_cores(cases.size(), [&](std::size_t i) {
    const Case& c = cases[i];
    touched[i] = touch(c.link, c.wall_n_per_m, c.grip, c.m_per_s, c.seed);
  });
  double share = 0.0, differs_s = 0.0, swing_n = 0.0, least_n = INFINITY;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const Touched& t = touched[i];
    SCOPED_TRACE(std::string(c.link) + ", " + std::to_string(c.wall_n_per_m) + " N/m, " +
                 (c.grip == Grip::kLight ? "light" : "firm") + ", " + std::to_string(c.m_per_s) +
                 " m/s, seed " + std::to_string(c.seed));
    EXPECT_NEAR(t.felt_n, t.tool_n / kScale, 0.2 * t.tool_n / kScale);
    EXPECT_LE(t.differs_s, kAgree_s);
    EXPECT_GE(t.felt_n, 1.0);
    EXPECT_LE(t.swing_n, 0.1);
    EXPECT_GE(t.energy_j, -0.021);
    share = std::max(share, std::abs(t.felt_n * kScale / t.tool_n - 1.0));
    differs_s = std::max(differs_s, t.differs_s);
    swing_n = std::max(swing_n, t.swing_n);
    least_n = std::min(least_n, t.felt_n);
  }
  std::printf(
      "%zu touches: felt as pressed within %.1f %% at rest and 20 %% after %.2f s, at least %.2f N, swing at most %.3f N\n",
      cases.size(), 100.0 * share, differs_s, least_n, swing_n);
}

}  // namespace
}  // namespace longreach::goal_follows_force_test
