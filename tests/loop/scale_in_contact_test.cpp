// The scale changes while the hand presses on a wall: what is felt is what the tool presses, with the slope of the wall. If
// the scale falls, the force on the hand stays and does not step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/loop/clocks_bench.hpp"

namespace longreach {
namespace {

constexpr double kWall_m = 0.02, kWall_n_per_m = 1000.0;

class Pressed {
 public:
  Pressed(const char* link, double scale, std::uint64_t seed)
      : bench_({std::string("profile=") + link, "mapping.mode=POSITION",
                "mapping.scale=" + std::to_string(scale),
                "scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0",
                "scene.material.wall.stiffness_n_per_m=" + std::to_string(kWall_n_per_m)},
               seed) {
    hand_.grip = Grip::kFirm;
    lab().drive(hand_);
    clocks::run(lab(), 6.0);
    EXPECT_TRUE(clocks::engage(lab(), 10.0));
    move_to((kWall_m + 0.001) / scale, 0.02, 8.0);  // slowly, so that the wall is known
    move_to((kWall_m + 0.006) / scale, 0.02, 8.0);
  }
  Laboratory& lab() { return *bench_.lab; }
  [[nodiscard]] double felt_n() { return -lab().master().spring_force_n.x(); }
  [[nodiscard]] double tool_n() { return lab().arm().true_wrench().force.norm(); }

  void change_scale(double scale) {
    lab().requests().scale = scale;
    wait(0.5);
  }
  void wait(double seconds) { move_to(at_m_, 1.0, seconds); }
  /// Force over way of the handle, while the hand presses further by 2 mm.
  double probe_n_per_m() {
    const double from_m = lab().master().p_MH.x(), from_n = felt_n();
    move_to(at_m_ + 0.02, 0.02, 0.0);
    return (felt_n() - from_n) / (lab().master().p_MH.x() - from_m);
  }
  double step_n = 0.0;  // largest change of the force in a tick

 private:
  void move_to(double x_m, double m_per_s, double rests_s) {
    const double from_m = at_m_, begin_s = lab().now_s(), lasts_s = std::abs(x_m - from_m) / m_per_s;
    while (lab().now_s() < begin_s + lasts_s + rests_s) {
      const double share = lasts_s > 0.0 ? std::min(1.0, (lab().now_s() - begin_s) / lasts_s) : 1.0;
      at_m_ = from_m + share * (x_m - from_m);
      hand_.position_m = {at_m_, 0.0, 0.0};
      lab().drive(hand_);
      const double before_n = felt_n();
      lab().step();
      step_n = std::max(step_n, std::abs(felt_n() - before_n));
    }
  }

  clocks::Bench bench_;
  HandTarget hand_{};
  double at_m_ = 0.0;
};

TEST(ScaleInContact, WhatIsFeltIsWhatTheToolPresses) {
  constexpr double kStep_n = 0.3, kRoundTrip_s = 3.0;
  for (const char* link : {"lab", "moon"}) {
    for (const std::uint64_t seed : {1u, 72u}) {
      for (const auto& [from, to] : {std::pair{0.8, 0.5}, {0.8, 0.2}, {1.0, 0.1}, {0.3, 0.6}}) {
        Pressed p(link, from, seed);
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
        EXPECT_NEAR(slope, kWall_n_per_m, 0.1 * kWall_n_per_m);
      }
    }
  }
}

}  // namespace
}  // namespace longreach
