// A wall approaches a tool that the operator holds at rest, before anything was touched. The tool moves back a little, learns
// the stiffness, and the hand feels the wall while it presses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/loop/clocks_bench.hpp"

namespace longreach::coming_wall_test {
namespace {

constexpr double kScale = 0.8;

struct Came {
  double pressed_n =
      0.0;  // at the tool when 0.5 N were felt first, without what grew during the delay of the link
  double lead_m = 0.0;  // largest distance between tool and goal
  double differs_n =
      0.0;  // difference at the end that the motion of the wall during a round trip does not explain
  double felt_n = 0.0, tool_n = 0.0;  // at the end
  double least_n = 1e9,
         most_n = 0.0;  // smallest felt force, and largest at the tool, since it was felt first
};

Came come(const std::string& link, double wall_n_per_m, double m_per_s, Grip grip) {
  clocks::Bench bench({"profile=" + link, "mapping.mode=POSITION", "mapping.scale=" + std::to_string(kScale),
                       "scene.surface.wall.plane.point_m=" + std::to_string(0.002 + 18.0 * m_per_s) + ",0,0",
                       "scene.surface.wall.movement.velocity_m_per_s=" + std::to_string(-m_per_s) + ",0,0",
                       "scene.material.wall.stiffness_n_per_m=" + std::to_string(wall_n_per_m)},
                      72);
  Laboratory& lab = *bench.lab;
  HandTarget hand;
  hand.grip = grip;
  lab.drive(hand);
  clocks::run(lab, 6.0);
  EXPECT_TRUE(clocks::engage(lab, 12.0));
  const double rtt_s = lab.master().rtt_s.value_or(0.0), from_m = lab.arm().true_pose().p.x();
  Came seen;
  std::vector<double> tool_n;
  const auto delay = static_cast<std::size_t>(0.5e3 * rtt_s);
  double felt_s = -1.0;
  const double until_n = 12.0, end_s = lab.now_s() + 30.0 + 0.02 / m_per_s;
  while (lab.now_s() < end_s && seen.tool_n < until_n) {
    lab.step();
    seen.tool_n = lab.arm().true_wrench().force.norm();
    seen.felt_n = lab.master().spring_force_n.norm();
    tool_n.push_back(seen.tool_n / kScale);
    const double goal_m = from_m + lab.master().goal_m.x(), tool_m = lab.arm().true_pose().p.x();
    seen.lead_m = std::max(seen.lead_m, std::abs(goal_m - tool_m));
    const double due_n = tool_n.size() > delay ? tool_n[tool_n.size() - 1 - delay] : 0.0;
    if (felt_s < 0.0 && seen.felt_n > 0.5) felt_s = lab.now_s(), seen.pressed_n = due_n * kScale;
    if (felt_s < 0.0 || lab.now_s() < felt_s + 1.0 + rtt_s) continue;
    const double moved_n = wall_n_per_m * m_per_s * (rtt_s + 0.3) / kScale;
    seen.differs_n = std::abs(seen.felt_n - due_n) - moved_n - 0.2 * due_n;
    seen.least_n = std::min(seen.least_n, seen.felt_n);
    seen.most_n = std::max(seen.most_n, seen.tool_n);
  }
  EXPECT_GE(felt_s, 0.0) << "never felt";
  return seen;
}

TEST(ComingWall, IsLearntByGivingWayAndFeltByARestingHand) {
  for (const char* link : {"lab", "moon"}) {
    for (const double wall : {400.0, 1000.0, 5000.0}) {
      for (const double m_per_s : {3e-4, 2e-3, 3e-3}) {
        for (const Grip grip : {Grip::kLight, Grip::kFirm}) {
          // A wall that presses more than the guard within a round trip cannot be felt in time.
          if (wall * m_per_s > (std::string(link) == "lab" ? 5.0 : 2.0)) continue;
          if (std::string(link) != "lab" && m_per_s > 1e-3) continue;
          const Came c = come(link, wall, m_per_s, grip);
          std::printf(
              "%s, %4.0f N/m, %.1f mm/s, %s: felt from %.2f N, then at least %.2f N; tool at most %.2f N, lead %.2f mm; at "
              "the end felt %.2f N of %.2f N\n",
              link, wall, 1e3 * m_per_s, grip == Grip::kLight ? "light" : "firm", c.pressed_n, c.least_n,
              c.most_n, 1e3 * c.lead_m, c.felt_n, c.tool_n / kScale);
          EXPECT_LE(c.pressed_n, 7.0);
          EXPECT_LE(c.lead_m, 5e-3);
          EXPECT_LE(c.most_n, 10.0);
          // Over the Moon, hand and goal move for as long as the wall approaches, and the tool may leave it.
          if (std::string(link) == "lab") {
            EXPECT_GE(c.least_n, 0.3);
            EXPECT_LE(c.differs_n, 0.1);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace longreach::coming_wall_test
