// One wall, one link and one hand: the behaviour of each comparison law over time. `rendering.law` selects
// one of them; the stiffness law has the experiment `touch`.

#include <cmath>
#include <limits>
#include <map>

#include "common/config/config.hpp"
#include "deploy/lab/comparison/comparison_law.hpp"
#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/delay/delay_limits.hpp"
#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/report/answer.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr std::size_t kLaws = 5;  // the comparison laws in kLawNames
constexpr int kSamplesPerRow = 10;

struct Seen {
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  double force_n = std::numeric_limits<double>::quiet_NaN();
  double energy_j = std::numeric_limits<double>::quiet_NaN();
};

BilateralCase case_of(const ExperimentRun& run) {
  const MasterConfig master = to_struct(run.config.master());
  const SlaveConfig slave = to_struct(run.config.slave());
  BilateralCase c;
  c.device = ideal_device(master.device);
  c.grip = master.hand.grip;
  c.rtt_s = master.link.impairment.delay_s + slave.link.impairment.delay_s;
  c.jitter_s = std::max(master.link.impairment.jitter_s, slave.link.impairment.jitter_s);
  c.loss = std::max(master.link.impairment.loss, slave.link.impairment.loss);
  c.wall_n_per_m = slave.scene.material.front().stiffness_n_per_m;
  c.seed = run.seed;
  c.config.coupling_n_per_m = tuned_coupling_n_per_m(c.device, c.config, c.rtt_s);
  return c;
}

}  // namespace

std::vector<Plot> press_wall_plots() {
  std::vector<Panel> panels = {{"penetration of the hand (mm)", {}, ""},
                               {"force on the hand (N)", {}, ""},
                               {"energy from the hand (mJ)", {}, ""}};
  for (std::size_t i = 0; i < kLaws; ++i) {
    const std::string law(kLawNames[i].column), title(kLawNames[i].title);
    panels[0].curves.push_back({.column = law + "_depth_m", .title = title, .factor = 1e3});
    panels[1].curves.push_back({.column = law + "_force_n", .title = ""});
    panels[2].curves.push_back({.column = law + "_energy_j", .title = "", .factor = 1e3});
  }
  return {{.name = "press_wall",
           .csv = "press_wall",
           .title = "Pressing on a wall across the link with each textbook law",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = panels}};
}

// The limit cycle of direct force is a hundred times larger than the other curves, which would shrink to a
// line.
void fit_press_wall(Plot& plot, const std::vector<Metric>& metrics) {
  std::map<std::string, double> found;
  for (const Metric& m : metrics) found[m.name] = m.value;
  plot.title = "Pressing on a wall of " + figure(1e-3 * found["wall_n_per_m"]) +
               " N/mm over a round trip of " + figure(found["rtt_s"]) + " s";
  if (found["direct_limit_cycle"] == 0.0 || !found.contains("wave_limit_cycle")) return;
  plot.title += "; direct force exceeds the axes: " + figure(found["direct_force_peak_n"]) + " N and " +
                figure(1e3 * found["direct_port_energy_min_j"]) + " mJ";
  for (Panel& panel : plot.panels) panel.curves.front().scales = false;
}

std::vector<Metric> run_press_wall(const ExperimentRun& run) {
  BilateralCase c = case_of(run);
  const RenderingLaw only = to_struct(run.config.master()).rendering.law;
  if (run.config.master().rendering().has_law() && !is_comparison(only))
    throw ConfigError("press-wall runs only the textbook laws; for rendering.law = " +
                      proto::Rendering::Law_Name(run.config.master().rendering().law()) +
                      " run the experiment touch");
  std::vector<std::array<Seen, kLaws>> rows;
  std::vector<Metric> metrics = {{"rtt_s", c.rtt_s, "s"}, {"wall_n_per_m", c.wall_n_per_m, "N/m"}};
  for (std::size_t i = 0; i < kLaws; ++i) {
    c.law = kLawNames[i].law;
    if (only != RenderingLaw::kStiffness && only != c.law) continue;
    std::size_t sample = 0;
    const Pressed found = press_wall(c, [&](const BilateralBench& bench) {
      if (sample % kSamplesPerRow == 0) {
        const std::size_t row = sample / kSamplesPerRow;
        if (rows.size() <= row) rows.emplace_back();
        rows[row][i] = {bench.depth_m(), bench.force_n(), bench.port_energy_j()};
      }
      ++sample;
    });
    const std::string name(kLawNames[i].column);
    metrics.push_back({name + "_displayed_n_per_m", found.displayed_n_per_m, "N/m"});
    metrics.push_back({name + "_limit_cycle", found.limit_cycle ? 1.0 : 0.0, ""});
    metrics.push_back({name + "_port_energy_min_j", found.port_energy_min_j, "J"});
    metrics.push_back({name + "_force_peak_n", found.force_peak_n, "N"});
    if (run.progress) run.progress(static_cast<double>(i + 1) / kLaws);
  }
  Trace trace(run.out, "press_wall",
              {"t_s", "direct_depth_m", "direct_force_n", "direct_energy_j", "position_position_depth_m",
               "position_position_force_n", "position_position_energy_j", "wave_depth_m", "wave_force_n",
               "wave_energy_j", "tdpa_depth_m", "tdpa_force_n", "tdpa_energy_j", "tank_depth_m",
               "tank_force_n", "tank_energy_j"});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto& s = rows[row];
    trace.row({static_cast<double>(row) * kSamplesPerRow * kBenchPeriod_s, s[0].depth_m, s[0].force_n,
               s[0].energy_j, s[1].depth_m, s[1].force_n, s[1].energy_j, s[2].depth_m, s[2].force_n,
               s[2].energy_j, s[3].depth_m, s[3].force_n, s[3].energy_j, s[4].depth_m, s[4].force_n,
               s[4].energy_j});
  }
  trace.close();
  if (run.progress) run.progress(1.0);
  return metrics;
}

}  // namespace longreach
