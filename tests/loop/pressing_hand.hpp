#pragma once
// A hand that presses on a wall of the simulated scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/loop/clocks_bench.hpp"

namespace longreach {

class PressingHand {
 public:
  static constexpr double kWall_m = 0.02, kWall_n_per_m = 1000.0;

  PressingHand(const char* link, double scale, std::uint64_t seed)
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
  void clutch(bool pressed) { hand_.buttons.clutch = pressed; }
  /// Force over way of the handle, while the hand presses further by 2 mm.
  double probe_n_per_m() {
    const double from_m = lab().master().p_MH.x(), from_n = felt_n();
    move_to(at_m_ + 0.02, 0.02, 0.0);
    return (felt_n() - from_n) / (lab().master().p_MH.x() - from_m);
  }
  double step_n = 0.0;  // largest change of the whole force on the hand in a tick
  double beyond_n =
      0.0;  // the same beyond 1.2 times what the hand's motion changes by the stiffness of the wall

 private:
  void move_to(double x_m, double m_per_s, double rests_s) {
    const double from_m = at_m_, begin_s = lab().now_s(), lasts_s = std::abs(x_m - from_m) / m_per_s;
    while (lab().now_s() < begin_s + lasts_s + rests_s) {
      const double share = lasts_s > 0.0 ? std::min(1.0, (lab().now_s() - begin_s) / lasts_s) : 1.0;
      at_m_ = from_m + share * (x_m - from_m);
      hand_.position_m = {at_m_, 0.0, 0.0};
      lab().drive(hand_);
      const double before_n = lab().master().F_H_M.force.x(), before_m = lab().master().p_MH.x();
      lab().step();
      const double changed_n = std::abs(lab().master().F_H_M.force.x() - before_n);
      step_n = std::max(step_n, changed_n);
      beyond_n =
          std::max(beyond_n, changed_n - 1.2 * kWall_n_per_m * std::abs(lab().master().p_MH.x() - before_m));
    }
  }

  clocks::Bench bench_;
  HandTarget hand_{};
  double at_m_ = 0.0;
};

}  // namespace longreach
