// The scale changes while the hand presses on a wall: what is felt is what the tool presses, with the slope of the wall. If
// the scale falls, the force on the hand stays and does not step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/loop/pressing_hand.hpp"

namespace longreach::scale_in_contact_test {
namespace {

TEST(ScaleInContact, WhatIsFeltIsWhatTheToolPresses) {
  constexpr double kStep_n = 0.3, kRoundTrip_s = 3.0;
  for (const char* link : {"lab", "moon"}) {
    for (const std::uint64_t seed : {1u, 72u}) {
      for (const auto& [from, to] : {std::pair{0.8, 0.5}, {0.8, 0.2}, {1.0, 0.1}, {0.3, 0.6}}) {
        PressingHand p(link, from, seed);
        const double before_n = p.felt_n();
        ASSERT_GT(before_n, 1.5);
        p.step_n = 0.0;
        p.change_scale(to);
        if (to < from) EXPECT_LE(p.step_n, kStep_n);
        p.wait(kRoundTrip_s);
        const double after_n = p.felt_n(), tool_n = p.tool_n();
        const double slope = p.probe_n_per_m();
        std::printf("%s, seed %d, scale %.1f to %.1f: felt %.2f, then %.2f N, tool %.2f N, slope %.0f N/m\n",
                    link, static_cast<int>(seed), from, to, before_n, after_n, tool_n, slope);
        if (to < from) EXPECT_NEAR(after_n, before_n, 0.15 * before_n);
        EXPECT_NEAR(after_n, tool_n / to, 0.2 * after_n);
        EXPECT_NEAR(slope, PressingHand::kWall_n_per_m, 0.1 * PressingHand::kWall_n_per_m);
      }
    }
  }
}

}  // namespace
}  // namespace longreach::scale_in_contact_test
