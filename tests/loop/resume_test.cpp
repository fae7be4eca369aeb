// A hand that presses on a wall through an outage of the link: the tool presses no harder than before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/loop/clocks_bench.hpp"

namespace longreach::resume_test {
namespace {

constexpr double kWall_m = 0.02;

struct Pressing {
  explicit Pressing(std::vector<std::string> more, std::uint64_t seed)
      : bench(settings(std::move(more)), seed) {}

  static std::vector<std::string> settings(std::vector<std::string> more) {
    for (const char* setting : {"mapping.mode=POSITION", "mapping.scale=1"}) more.emplace_back(setting);
    more.push_back("scene.surface.wall.plane.point_m=" + std::to_string(kWall_m) + ",0,0");
    return more;
  }
  Laboratory& lab() { return *bench.lab; }
  double force_n() { return lab().arm().true_wrench().force.norm(); }
  void hand(double x_m) {
    HandTarget target;
    target.grip = Grip::kFirm;
    target.position_m = {x_m, 0.0, 0.0};
    lab().drive(target);
  }
  /// Moves the hand to this place at this speed and waits.
  void move(double x_m, double m_per_s, double waits_s) {
    const double from_m = at_m, begin_s = lab().now_s(), lasts_s = std::abs(x_m - from_m) / m_per_s;
    while (lab().now_s() < begin_s + lasts_s) {
      hand(from_m + (x_m - from_m) * (lab().now_s() - begin_s) / lasts_s);
      lab().step();
      most_n = std::max(most_n, force_n());
    }
    at_m = x_m;
    hand(x_m);
    watch(waits_s);
  }
  void watch(double seconds) {
    for (const double end_s = lab().now_s() + seconds; lab().now_s() < end_s;) {
      lab().step();
      most_n = std::max(most_n, force_n());
    }
  }

  clocks::Bench bench;
  double at_m = 0.0, most_n = 0.0;
};

TEST(Resume, AfterAnOutageInContactTheToolPressesNoHarder) {
  for (const std::uint64_t seed : {1u, 5u, 23u}) {
    for (const double outage_s : {0.6, 0.7, 1.0, 1.5}) {
      Pressing p({"profile=lab"}, seed);
      p.hand(0.0);
      clocks::run(p.lab(), 0.5);
      ASSERT_TRUE(clocks::engage(p.lab(), 2.0));
      p.move(kWall_m + 0.02, 0.02, 6.0);
      const double before_n = p.force_n();
      ASSERT_GT(before_n, 3.0);
      p.lab().impair_slave({.loss = 1.0});
      p.lab().impair_master({.loss = 1.0});
      clocks::run(p.lab(), outage_s);
      p.lab().impair_slave({});
      p.lab().impair_master({});
      p.most_n = 0.0;
      p.watch(5.0);
      std::printf("resume, seed %d, %.1f s: %.2f N before, at most %.2f N after, %.2f N at the end\n",
                  static_cast<int>(seed), outage_s, before_n, p.most_n, p.force_n());
      EXPECT_LE(p.most_n, before_n + 0.5) << seed << ' ' << outage_s;
    }
  }
}

}  // namespace
}  // namespace longreach::resume_test
