#include "deploy/lab/rendering/first_touch_guard.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/lab/rendering/guard_touch.hpp"
#include "deploy/lab/trace.hpp"
#include "slave/config/guard_config.hpp"

namespace longreach {
namespace {

using test::GuardCase;
using test::GuardTouch;

constexpr double kShownGuard_n = 8.0;
constexpr double kBefore_s = 0.02, kAfter_s = 0.4;  // of the touch, that is shown

/// The cases in the trace: guard, delay, deceleration, mass, servo.
std::array<GuardCase, 4> shown() {
  std::array<GuardCase, 4> cases{{{kShownGuard_n, 4e-3, 1.25, 10.0, 3.0},
                                  {kShownGuard_n, 4e-3, 1.25, 1.0, 20.0},
                                  {kShownGuard_n, 1e-3, 1.25, 0.0, 10.0},
                                  {kShownGuard_n, 4e-3, 1.25, 10.0, 3.0}}};
  cases.back().guarded = false;
  return cases;
}

void write(const std::filesystem::path& out) {
  Trace trace(out, "first-touch-guard",
              {"t_s", "heavy_n", "light_n", "rigid_n", "without_n", "heavy_m", "light_m", "rigid_m",
               "without_m", "guard_n", "most_n"});
  std::array<GuardTouch, 4> touches;
  std::ranges::transform(shown(), touches.begin(), test::guard_touch);
  for (int i = -static_cast<int>(1e3 * kBefore_s); i < static_cast<int>(1e3 * kAfter_s); ++i) {
    std::array<test::GuardRow, 4> row;
    for (std::size_t c = 0; c < row.size(); ++c)
      row[c] = touches[c].rows[static_cast<std::size_t>(std::lround(1e3 * touches[c].touched_s) + i)];
    const auto depth = [&](std::size_t c) { return row[c].tool_m - test::kGuardWall_m; };
    trace.row({1e-3 * i, row[0].force_n, row[1].force_n, row[2].force_n, row[3].force_n, depth(0), depth(1),
               depth(2), depth(3), kShownGuard_n, kGuardOvershoot * kShownGuard_n});
  }
  trace.close();
}

}  // namespace

std::vector<Metric> run_first_touch_guard(const std::filesystem::path& out) {
  double with = 0.0, without = 0.0, count = 0.0;
  for (GuardCase c : test::guard_sample()) {
    with = std::max(with, test::guard_touch(c).peak_n / c.guard_n);
    c.guarded = false;
    without = std::max(without, test::guard_touch(c).peak_n / c.guard_n);
    ++count;
  }
  GuardCase held{.guard_n = 20.0, .mass_kg = 0.0, .then = test::Then::kSilence};
  const double left_n = test::guard_touch(held).rows.back().force_n;
  if (!out.empty()) write(out);
  return {{"guard_touches", count, ""},
          {"guard_peak_over_guard_max", with, ""},
          {"guard_peak_over_guard_max_without_guard", without, ""},
          {"hold_force_over_guard", left_n / held.guard_n, ""}};
}

Plot first_touch_guard_plot() {
  const auto curves = [](const std::string& unit, double factor) {
    return std::vector<Curve>{{"without_" + unit, "10 kg, no guard", factor, false, 7, 1},
                              {"heavy_" + unit, "10 kg, servo 3 Hz", factor, false, 7, 0},
                              {"light_" + unit, "1 kg, servo 20 Hz", factor, false, 7, 2},
                              {"rigid_" + unit, "rigid, servo 10 Hz", factor, false, 7, 3}};
  };
  std::vector<Curve> forces = curves("n", 1.0);
  forces.push_back({"guard_n", "guard, 8 N", 1.0, false, 7, 5});
  forces.push_back({"most_n", "1.35 x guard", 1.0, false, 7, 4});
  return {.name = "first-touch-guard",
          .csv = "first-touch-guard",
          .title = "The force guard at the slave: touching a wall of 5 N/mm at 50 mm/s",
          .x_column = "t_s",
          .x_label = "time since the touch (ms)",
          .x_factor = 1e3,
          .panels = {{"force at the tool (N)", forces, "set yrange [0:20]\nset xrange [-20:400]"},
                     {"depth of the tool (mm)", curves("m", 1e3), "set yrange [-1:4]"}},
          .panel_px = 260.0};
}

}  // namespace longreach
