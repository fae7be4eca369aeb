#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/slave/node_loop.hpp"

namespace longreach::lost_commands_test {
namespace {

// The goal slows down at the wall, so that it is not on the line between the commands beside those that were lost.
TEST(LostCommands, SurfaceIsPlacedExactly) {
  constexpr double kWall_m = 0.05, kDeepest_m = 0.055, kSlows_s = 0.1;
  test::Loop loop(test::wall_config(kWall_m, 1000.0));
  loop.engage();
  for (int i = 0; i < 3000; ++i) {
    loop.command.position_m.x() = kDeepest_m * -std::expm1(-1e-3 * i / kSlows_s);
    loop.lost = std::abs(loop.command.position_m.x() - kWall_m) < 1e-3;
    loop.tick();
  }
  const ReportedSurface& surface = loop.last_report->translation.surfaces[0];
  ASSERT_TRUE(surface.pressed);
  const auto before = static_cast<std::size_t>(surface.touch_sequence);
  const double part = surface.touch_sequence - static_cast<double>(before);
  const double place_m = before > 0 ? std::lerp(loop.goals_x[before], loop.goals_x[before + 1], part)
                                    : surface.normal.x() * surface.offset;
  EXPECT_NEAR(place_m, kWall_m, 5e-5);
}

}  // namespace
}  // namespace longreach::lost_commands_test
