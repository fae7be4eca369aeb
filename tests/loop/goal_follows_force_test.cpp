// A hand rests after a first touch: what it feels is what the tool presses, because the goal moves out of the wall as far
// as the spring at the hand cannot carry it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/loop/clocks_bench.hpp"

namespace longreach {
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
  constexpr double kScale = 0.8;
  for (const char* link : {"lab", "kontur", "moon"}) {
    for (const double wall : {200.0, 400.0, 1000.0, 5000.0}) {
      for (const Grip grip : {Grip::kLight, Grip::kFirm}) {
        for (const double m_per_s : {0.03, 0.2}) {
          const Touched t = touch(link, wall, grip, m_per_s, 72);
          std::printf(
              "%s, %4.0f N/m, %s, %.2f m/s: felt %.2f N, tool %.2f N / scale = %.2f N, swing %.3f N, %.4f J, differ %.2f s\n",
              link, wall, grip == Grip::kLight ? "light" : "firm", m_per_s, t.felt_n, t.tool_n,
              t.tool_n / kScale, t.swing_n, t.energy_j, t.differs_s);
          EXPECT_NEAR(t.felt_n, t.tool_n / kScale, 0.2 * t.tool_n / kScale);
          EXPECT_GE(t.felt_n, 1.0);
          EXPECT_LE(t.swing_n, 0.1);
          EXPECT_GE(t.energy_j, -0.021);
        }
      }
    }
  }
}

}  // namespace
}  // namespace longreach
