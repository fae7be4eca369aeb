// A hand that presses on a wall and stops suddenly: the tool does not go past its goal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/loop/clocks_bench.hpp"

namespace longreach::stop_in_contact_test {
namespace {

constexpr double kWall_m = 0.02;

struct Stop {
  double past_m = 0.0;  // most that the tool was behind its own goal
  double most_n = 0.0, rest_n = 0.0;
};

Stop stop_in_contact(double m_per_s, double jitter_s, std::uint64_t seed) {
  clocks::Bench bench({"profile=lab", "mapping.mode=POSITION", "mapping.scale=1",
                       "scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0"},
                      seed);
  Laboratory& lab = *bench.lab;
  HandTarget hand;
  hand.grip = Grip::kFirm;
  const auto move = [&](double from_m, double to_m, double speed, double rests_s, Stop* out) {
    const double begin_s = lab.now_s(), lasts_s = std::abs(to_m - from_m) / speed;
    while (lab.now_s() < begin_s + lasts_s + rests_s) {
      const double share = std::min(1.0, (lab.now_s() - begin_s) / lasts_s);
      hand.position_m = {from_m + (to_m - from_m) * share, 0.0, 0.0};
      lab.drive(hand);
      lab.step();
      if (!out) continue;
      out->most_n = std::max(out->most_n, lab.arm().true_wrench().force.norm());
      out->past_m = std::max(out->past_m, lab.slave().X_WE.p.x() - lab.slave().X_WE_goal.p.x());
    }
  };
  lab.drive(hand);
  clocks::run(lab, 0.5);
  EXPECT_TRUE(clocks::engage(lab, 2.0));
  lab.impair_master({.delay_s = 0.0005, .jitter_s = jitter_s});
  lab.impair_slave({.delay_s = 0.0005, .jitter_s = jitter_s});
  move(0.0, kWall_m + 0.006, 0.02, 6.0, nullptr);  // until the wall is known
  Stop out;
  move(kWall_m + 0.006, kWall_m + 0.009, m_per_s, 2.0, &out);
  out.rest_n = lab.arm().true_wrench().force.norm();
  return out;
}

TEST(StopInContact, TheToolGoesPastItsGoalByLessThanASendPeriodMoves) {
  constexpr double kSendHz = 300.0, kRounding_m = 5e-5, kLittle_n = 0.3;
  for (const double m_per_s : {0.02, 0.04, 0.15}) {
    for (const double jitter_s : {0.0, 0.001, 0.003}) {
      for (const std::uint64_t seed : {1u, 42u}) {
        const Stop s = stop_in_contact(m_per_s, jitter_s, seed);
        std::printf(
            "stop at %.0f mm/s, jitter %.0f ms: %.3f mm past the goal, at most %.2f N, %.2f N at rest\n",
            1e3 * m_per_s, 1e3 * jitter_s, 1e3 * s.past_m, s.most_n, s.rest_n);
        EXPECT_LE(s.past_m, kRounding_m + m_per_s / kSendHz);
        EXPECT_LE(s.most_n, s.rest_n + kLittle_n);
        EXPECT_GT(s.rest_n, 2.0);
      }
    }
  }
}

}  // namespace
}  // namespace longreach::stop_in_contact_test
