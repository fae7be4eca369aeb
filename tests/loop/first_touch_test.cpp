// The first touch of a surface that nothing has announced, by a hand that moves at a constant speed: the force at the tool,
// and what the speed limit of unknown space costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/clocks_bench.hpp"

namespace longreach::first_touch_test {
namespace {

constexpr double kWall_m = 0.05, kGuard_n = 20.0, kOvershoot = 1.35;

struct FirstTouchCase {
  bool rate = false;
  double m_per_s = 0.0;  // commanded speed of the tool
  double n_per_m = 0.0;
  std::uint64_t seed = 1;
  double assumed_n_per_m = 20000.0;  // command.guard_stiffness_n_per_m
};

std::ostream& operator<<(std::ostream& out, const FirstTouchCase& c) {
  return out << (c.rate ? "rate, " : "position, ") << c.m_per_s << " m/s, " << c.n_per_m << " N/m, seed "
             << c.seed;
}

struct FirstTouchResult {
  double reached_s = INFINITY;  // from the start of the motion until the tool is where the wall is
  double peak_n = 0.0;
  std::uint64_t limit_violations = 0;
};

/// Without `wall`, neither a surface nor a guard slows the robot.
FirstTouchResult drive(const FirstTouchCase& c, bool wall) {
  constexpr double kDeflection_m = 0.04, kDeflects_s = 0.1, kLasts_s = 4.0;
  std::vector<std::string> settings{
      "profile=lab", std::string("mapping.mode=") + (c.rate ? "RATE" : "POSITION"), "mapping.scale=1",
      "mapping.speed_max_m_per_s=" + std::to_string(c.m_per_s), "mapping.kv_per_s=10"};
  if (wall) {
    settings.push_back("command.guard_stiffness_n_per_m=" + std::to_string(c.assumed_n_per_m));
    settings.push_back("scene.material.wall.stiffness_n_per_m=" + std::to_string(c.n_per_m));
    settings.push_back("scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0");
  } else {
    settings.insert(settings.end(), {"scene_file=scenes/free.txtpb", "sensing.force=false"});
  }
  clocks::Bench bench(settings, c.seed);
  Laboratory& lab = *bench.lab;
  HandTarget hand;
  hand.grip = Grip::kFirm;
  lab.drive(hand);
  clocks::run(lab, 0.5);
  FirstTouchResult result;
  if (!clocks::engage(lab, 2.0)) return result;
  const double begin_s = lab.now_s();
  while (lab.now_s() < begin_s + kLasts_s) {
    const double t_s = lab.now_s() - begin_s;
    const double x_m =
        c.rate ? kDeflection_m * std::min(t_s / kDeflects_s, 1.0) : std::min(c.m_per_s * t_s, 1.2 * kWall_m);
    hand.position_m = {x_m, 0.0, 0.0};
    lab.drive(hand);
    lab.step();
    const double x = (lab.arm().true_pose().p - lab.arm().start_pose().p).x();
    if (x >= kWall_m && std::isinf(result.reached_s)) result.reached_s = t_s;
    result.peak_n = std::max(result.peak_n, lab.arm().true_wrench().force.norm());
  }
  result.limit_violations = lab.slave().limit_violations;
  return result;
}

TEST(FirstTouch, StaysWithinTheGuardAtEverySpeedInBothModes) {
  double worst_n = 0.0;
  for (const bool rate : {false, true}) {
    for (const double n_per_m : {5e3, 1e4, 2e4}) {
      for (const double m_per_s : {0.025, 0.05, 0.08, 0.15}) {
        for (const std::uint64_t seed : {3u, 17u}) {
          const FirstTouchCase c{rate, m_per_s, n_per_m, seed};
          const FirstTouchResult result = drive(c, true);
          EXPECT_LT(result.reached_s, INFINITY) << c;
          EXPECT_LE(result.peak_n, kOvershoot * kGuard_n) << c;
          EXPECT_EQ(result.limit_violations, 0u) << c;
          worst_n = std::max(worst_n, result.peak_n);
        }
      }
    }
  }
  std::printf("first touch: at most %.1f N with a guard of %.0f N\n", worst_n, kGuard_n);
}

// The control: the limit follows from the stiffness that is assumed, so a wall ten times as stiff is touched too hard.
TEST(FirstTouch, IsTooHardOnAWallThatIsMuchStifferThanAssumed) {
  const FirstTouchCase c{.rate = true, .m_per_s = 0.15, .n_per_m = 2e4, .assumed_n_per_m = 2e3};
  EXPECT_GT(drive(c, true).peak_n, kOvershoot * kGuard_n);
}

// Compared with a robot that nothing slows down, at up to 1.5 times the approach speed of 78 mm/s.
TEST(FirstTouch, TakesAtMostHalfAsLongAgain) {
  for (const bool rate : {false, true}) {
    for (const double m_per_s : {0.025, 0.05, 0.08, 0.117}) {
      const FirstTouchCase c{rate, m_per_s, 1e4, 5};
      const double free_s = drive(c, false).reached_s, limited_s = drive(c, true).reached_s;
      std::printf("first touch, %s, %.0f mm/s: after %.2f s, not limited %.2f s\n",
                  rate ? "rate" : "position", 1e3 * m_per_s, limited_s, free_s);
      EXPECT_LE(limited_s, 1.5 * free_s) << c;
    }
  }
}

}  // namespace
}  // namespace longreach::first_touch_test
