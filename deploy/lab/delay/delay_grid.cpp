#include "deploy/lab/delay/delay_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

#include "deploy/lab/delay/delay_limits.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kLargestCoupling_n_per_m = 2000.0;  // of a device at 1 kHz
constexpr double kCouplingMargin = 0.8;              // fraction of the limit from the stability condition

double given_mj(const Pressed& p) { return std::max(1e-4, -1e3 * p.port_energy_min_j); }

}  // namespace

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

bool DelayGrid::has_rtt(double s) const { return std::ranges::find(rtt_s, s) != rtt_s.end(); }

const Pressed& DelayResults::at(RenderingLaw law, double rtt_s, double wall_n_per_m, Grip grip) const {
  for (const DelayResult& r : results_) {
    if (r.law == law && r.rtt_s == rtt_s && r.wall_n_per_m == wall_n_per_m && r.grip == grip) return r.found;
  }
  throw std::out_of_range("the delay sweep does not contain this case");
}

double DelayResults::displayable_n_per_m(RenderingLaw law, double rtt_s, Grip grip) const {
  double most = 0.0;
  for (const DelayResult& r : results_) {
    if (r.law == law && r.rtt_s == rtt_s && r.grip == grip && !r.found.limit_cycle)
      most = std::max(most, std::min(r.found.displayed_n_per_m, r.wall_n_per_m));
  }
  return most;
}

void LawSummary::add(const DelayResult& r) {
  ++cases;
  limit_cycles += r.found.limit_cycle;
  right += !r.found.limit_cycle && r.error <= 0.05;
  error_max = std::max(error_max, r.error);
  port_energy_min_j = std::min(port_energy_min_j, r.found.port_energy_min_j);
  drawdown_max_j = std::max(drawdown_max_j, r.found.drawdown_j);
}

LawSummary DelayResults::summary(RenderingLaw law) const {
  LawSummary s;
  for (const DelayResult& r : results_) {
    if (r.law == law) s.add(r);
  }
  return s;
}

void DelayResults::write(const std::filesystem::path& folder) const {
  Trace all(folder, "sweep",
            {"law", "rtt_s", "wall_n_per_m", "grip", "displayed_n_per_m", "error", "limit_cycle", "motion_m",
             "port_energy_min_j", "drawdown_j", "force_peak_n"});
  /// By wall and delay: displayed and true stiffness.
  std::map<double, std::map<double, std::array<double, 12>>> walls;
  for (const DelayResult& r : results_) {
    const Pressed& p = r.found;
    all.row({static_cast<double>(r.law), r.rtt_s, r.wall_n_per_m, static_cast<double>(r.grip),
             p.displayed_n_per_m, r.error, p.limit_cycle ? 1.0 : 0.0, p.motion_m, p.port_energy_min_j,
             p.drawdown_j, p.force_peak_n});
    if (r.grip != Grip::kLight) continue;
    const auto law =
        static_cast<std::size_t>(std::ranges::find(kLawNames, r.law, &LawName::law) - kLawNames.begin());
    auto& row = walls[r.wall_n_per_m][r.rtt_s];
    row[law] = p.limit_cycle ? std::numeric_limits<double>::quiet_NaN()
                             : std::clamp(p.displayed_n_per_m / r.wall_n_per_m, 0.0, 2.0);
    row[6 + law] = given_mj(p);
  }
  all.close();
  for (const auto& [wall_n_per_m, rows] : walls) {
    Trace trace(folder, short_number(wall_n_per_m) + "_n_per_m",
                {"rtt_s", "direct", "position_position", "wave", "tdpa", "tank", "stiffness",
                 "direct_given_mj", "position_position_given_mj", "wave_given_mj", "tdpa_given_mj",
                 "tank_given_mj", "stiffness_given_mj"});
    for (const auto& [rtt_s, v] : rows) {
      trace.row({rtt_s, v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10], v[11]});
    }
    trace.close();
  }
}

double tuned_coupling_n_per_m(const DeviceConfig& device, const ComparisonConfig& config, double rtt_s) {
  const double master_n_s_per_m = config.coupling_n_s_per_m + held_handle(device, Grip::kReleased).n_s_per_m;
  const double limit =
      position_position_limit_n_per_m(master_n_s_per_m, config.slave_n_s_per_m, bench_loop_s(rtt_s));
  return std::min(kLargestCoupling_n_per_m, kCouplingMargin * limit);
}

DelayResults sweep_delays(const ExperimentRun& run, const DelayGrid& grid, const DeviceConfig& device) {
  DelayResults results;
  const std::size_t cases =
      kLawNames.size() * grid.rtt_s.size() * grid.wall_n_per_m.size() * grid.grips.size();
  for (const LawName& law : kLawNames) {
    for (const double rtt_s : grid.rtt_s) {
      for (const double wall_n_per_m : grid.wall_n_per_m) {
        for (const Grip grip : grid.grips) {
          if (run.progress) run.progress(static_cast<double>(results.size()) / static_cast<double>(cases));
          if (law.law == RenderingLaw::kStiffness) {
            results.add(touch_across(run, plain_link(run.config, rtt_s), wall_n_per_m, grip));
            continue;
          }
          BilateralCase c{.law = law.law,
                          .device = device,
                          .grip = grip,
                          .rtt_s = rtt_s,
                          .wall_n_per_m = wall_n_per_m,
                          .seed = run.seed};
          c.config.coupling_n_per_m = tuned_coupling_n_per_m(device, c.config, rtt_s);
          const Pressed found = press_wall(c);
          results.add({law.law, rtt_s, wall_n_per_m, grip, found,
                       std::abs(found.displayed_n_per_m / wall_n_per_m - 1.0)});
        }
      }
    }
  }
  return results;
}

}  // namespace longreach
