// Which stiffness can be displayed at which delay? Runs every law x round trip x wall x hand. The comparison
// laws run on the simplified bench, the stiffness law in the whole laboratory, as in the experiment `touch`.
//
// Displayable stiffness (light hand): for DIRECT the stiffest wall that is stable, found by bisection; for
// the other laws the maximum that they display of any wall without a limit cycle.

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/delay/delay_limits.hpp"
#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kHardest_n_per_m = 5000.0;
// Lines for the values in the literature: light hand with a handle of 0.2 kg and 1 N s/m, b = 10 N s/m.
constexpr std::array kTableRtt_s = {0.03, 0.3, 0.85, 2.6, 3.0};
constexpr std::array kTableDirect_n_per_m = {262.0, 104.0, 96.0, 94.0, 93.0};
constexpr std::array kTableWave_n_per_m = {667.0, 67.0, 24.0, 7.7, 6.7};
constexpr double kTableHandle_kg = 0.2, kTableHandle_n_s_per_m = 1.0;

DelayGrid grid_of_size(bool full) {
  if (full) return {};
  return {.rtt_s = {0.03, 0.3, 3.0}, .grips = {Grip::kLight}};
}

BilateralCase direct_case(const DeviceConfig& device, Grip grip, double rtt_s) {
  return {.law = RenderingLaw::kDirect, .device = device, .grip = grip, .rtt_s = rtt_s};
}

/// Compares the measured limits of DIRECT with the delay margin for every hand and, with the handle assumed
/// in the table, with the table.
void check_direct(const ExperimentRun& run, const DelayGrid& grid, const DeviceConfig& device,
                  std::vector<Metric>& metrics) {
  Trace trace(run.out, "direct_limits", {"rtt_s", "grip", "measured_n_per_m", "delay_margin_n_per_m"});
  double worst = 0.0, worst_of_table = 0.0;
  for (const Grip grip : grid.grips) {
    for (const double rtt_s : grid.rtt_s) {
      const double exact = direct_limit_n_per_m(held_handle(device, grip), bench_loop_s(rtt_s));
      const double measured =
          measured_direct_limit_n_per_m(direct_case(device, grip, rtt_s), 2.0 * exact, 0.02);
      trace.row({rtt_s, static_cast<double>(grip), measured, exact});
      worst = std::max(worst, std::abs(measured / exact - 1.0));
    }
  }
  trace.close();
  const DeviceConfig table = ideal_handle(device, kTableHandle_kg, kTableHandle_n_s_per_m);
  for (std::size_t i = 0; i < kTableRtt_s.size(); ++i) {
    if (!grid.has_rtt(kTableRtt_s[i])) continue;
    const double measured = measured_direct_limit_n_per_m(direct_case(table, Grip::kLight, kTableRtt_s[i]),
                                                          2.0 * kTableDirect_n_per_m[i], 0.02);
    metrics.push_back({"direct_limit_at_" + short_number(kTableRtt_s[i]), measured, "N/m"});
    worst_of_table = std::max(worst_of_table, std::abs(measured / kTableDirect_n_per_m[i] - 1.0));
  }
  metrics.push_back({"direct_limit_error_max", worst, ""});
  metrics.push_back({"direct_table_error_max", worst_of_table, ""});
}

/// Stiffness of the wave line alone, from the displayed stiffness of the hardest wall.
void check_wave(const DelayGrid& grid, const DelayResults& results, std::vector<Metric>& metrics) {
  double worst = 0.0;
  for (std::size_t i = 0; i < kTableRtt_s.size(); ++i) {
    if (!grid.has_rtt(kTableRtt_s[i])) continue;
    const double shown =
        results.at(RenderingLaw::kWave, kTableRtt_s[i], kHardest_n_per_m, Grip::kLight).displayed_n_per_m;
    const double line = 1.0 / (1.0 / shown - 1.0 / kHardest_n_per_m);
    metrics.push_back({"wave_limit_at_" + short_number(kTableRtt_s[i]), line, "N/m"});
    worst = std::max(worst, std::abs(line / kTableWave_n_per_m[i] - 1.0));
  }
  metrics.push_back({"wave_table_error_max", worst, ""});
}

/// The stiffness of a wall that each law can display according to theory.
struct LimitLines {
  HeldHandle light;
  const DeviceConfig& device;
  ComparisonConfig config{};

  [[nodiscard]] double direct_n_per_m(double rtt_s) const {
    return direct_limit_n_per_m(light, bench_loop_s(rtt_s));
  }
  [[nodiscard]] double position_position_n_per_m(double wall_n_per_m, double rtt_s) const {
    return in_series(tuned_coupling_n_per_m(device, config, rtt_s), wall_n_per_m);
  }
  [[nodiscard]] double wave_n_per_m(double wall_n_per_m, double rtt_s) const {
    return in_series(wave_line_n_per_m(config.wave_n_s_per_m, rtt_s), wall_n_per_m);
  }
};

std::vector<double> delays_of_lines_s() {
  constexpr int kPoints = 160;
  std::vector<double> rtt_s;
  for (int i = 0; i <= kPoints; ++i)
    rtt_s.push_back(0.02 * std::pow(500.0, static_cast<double>(i) / kPoints));
  return rtt_s;
}

/// Fraction of each wall that a law can display; none where direct force is unstable.
void write_limits(const ExperimentRun& run, const DelayGrid& grid, const LimitLines& limits) {
  for (const double wall : grid.wall_n_per_m) {
    Trace trace(run.out, "limits_" + short_number(wall), {"rtt_s", "direct", "position_position", "wave"});
    for (const double rtt_s : delays_of_lines_s()) {
      trace.row({rtt_s, wall <= limits.direct_n_per_m(rtt_s) ? 1.0 : kNone,
                 limits.position_position_n_per_m(wall, rtt_s) / wall,
                 limits.wave_n_per_m(wall, rtt_s) / wall});
    }
    trace.close();
  }
}

/// Lines over the whole range of delays, and points at the measured delays.
void write_displayable(const ExperimentRun& run, const DelayGrid& grid, const DelayResults& results,
                       const LimitLines& limits) {
  Trace trace(run.out, "displayable",
              {"rtt_s", "direct_n_per_m", "position_position_n_per_m", "wave_n_per_m", "tdpa_n_per_m",
               "tank_n_per_m", "stiffness_n_per_m", "direct_line_n_per_m", "position_position_line_n_per_m",
               "wave_line_n_per_m", "wall_n_per_m"});
  for (const double rtt_s : delays_of_lines_s()) {
    trace.row({rtt_s, kNone, kNone, kNone, kNone, kNone, kNone,
               std::min(kHardest_n_per_m, limits.direct_n_per_m(rtt_s)),
               limits.position_position_n_per_m(kHardest_n_per_m, rtt_s),
               limits.wave_n_per_m(kHardest_n_per_m, rtt_s), kHardest_n_per_m});
  }
  for (const double rtt_s : grid.rtt_s) {
    const auto most = [&](RenderingLaw law) {
      const double shown = results.displayable_n_per_m(law, rtt_s, Grip::kLight);
      return shown > 0.0 ? shown : kNone;
    };
    const double limit = measured_direct_limit_n_per_m(direct_case(limits.device, Grip::kLight, rtt_s),
                                                       kHardest_n_per_m, 0.05);
    trace.row({rtt_s, limit, most(RenderingLaw::kPositionPosition), most(RenderingLaw::kWave),
               most(RenderingLaw::kTdpa), most(RenderingLaw::kTank), most(RenderingLaw::kStiffness), kNone,
               kNone, kNone, kNone});
  }
  trace.close();
}

void summarise(const DelayResults& results, std::vector<Metric>& metrics) {
  for (const LawName& law : kLawNames) {
    const LawSummary s = results.summary(law.law);
    const std::string name(law.column);
    metrics.push_back({name + "_cases", static_cast<double>(s.cases), ""});
    metrics.push_back({name + "_limit_cycles", static_cast<double>(s.limit_cycles), ""});
    metrics.push_back({name + "_within_5_percent", static_cast<double>(s.right), ""});
    metrics.push_back({name + "_displayed_error_max", s.error_max, ""});
    metrics.push_back({name + "_port_energy_min_j", s.port_energy_min_j, "J"});
    metrics.push_back({name + "_drawdown_max_j", s.drawdown_max_j, "J"});
  }
}

}  // namespace

std::vector<Metric> run_delay_sweep(const ExperimentRun& run) {
  const DelayGrid grid = grid_of_size(campaign(1, 0) == 1);
  const DeviceConfig device = ideal_device(to_struct(run.config.master()).device);
  std::vector<Metric> metrics;
  check_direct(run, grid, device, metrics);
  const DelayResults results = sweep_delays(run, grid, device);
  check_wave(grid, results, metrics);
  summarise(results, metrics);
  if (!run.out.empty()) {
    results.write(run.out);
    const LimitLines limits{held_handle(device, Grip::kLight), device};
    write_displayable(run, grid, results, limits);
    write_limits(run, grid, limits);
  }
  if (run.progress) run.progress(1.0);
  return metrics;
}

}  // namespace longreach
