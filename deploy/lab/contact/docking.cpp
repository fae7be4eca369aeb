// The docking task of the source paper (Fig. 20, 21) across a link: approach in rate mode, grasp in position
// mode, drag, dock. The operator feels success as a force that rises and vanishes. It is followed by runs
// with three deliberate mistakes. Each must be felt as a force against the motion and must leave robot and
// target in a safe state.

#include <algorithm>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/docking_task.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach {
namespace {

constexpr double kFeltLeast_n = 0.5;  // at the hand

void add(std::vector<Metric>& metrics, const std::string& prefix, const DockingOutcome& o) {
  metrics.push_back({prefix + "_felt_n", o.felt_mistake_n, "N"});
  metrics.push_back({prefix + "_tool_force_max_n", o.tool_force_max_n, "N"});
  metrics.push_back({prefix + "_target_speed_max_m_per_s", o.target_speed_max_m_per_s, "m/s"});
  metrics.push_back({prefix + "_safe", o.safe ? 1.0 : 0.0, ""});
}

}  // namespace

std::vector<Plot> docking_plots() {
  const auto plot = [](const std::string& name, const std::string& title) {
    return Plot{
        .name = name,
        .csv = name,
        .title = title,
        .x_column = "t_s",
        .x_label = "time (s)",
        .panels = {{"displacement of the tool (mm)",
                    {{"tool_x_m", "x", 1e3}, {"tool_y_m", "y", 1e3}, {"tool_z_m", "z", 1e3}},
                    ""},
                   {"distance from probe tip to catch (mm)", {{"striker_m", "tip of the probe", 1e3}}, ""},
                   {"force on the tool (N)", {{"force_x_n", "along x"}, {"force_n", "magnitude"}}, ""},
                   {"force that resists the hand (N)", {{"felt_n", "on the hand, from contact"}}, ""},
                   {"state",
                    {{"mode", "position mode (1: yes)"},
                     {"holds", "gripper holds the target", 0.9},
                     {"latched", "latched", 0.8}},
                    "set yrange [-0.1:1.3]"}},
        .panel_px = 150.0};
  };
  return {plot("docking", "Docking across the link: approach, grasp, drag and dock"),
          plot("docking_tilted", "Mistake: the target is not aligned"),
          plot("docking_misses_guide", "Mistake: the probe misses the guide"),
          plot("docking_pushes_on", "Mistake: the operator keeps pushing after the latch has yielded")};
}

std::vector<Metric> run_docking(const ExperimentRun& run) {
  const int seeds = campaign(30, 3), runs = seeds + kDockingMistakes - 1;
  int done = 0;
  const auto report = [&] {
    if (run.progress) run.progress(static_cast<double>(++done) / runs);
  };
  std::vector<Metric> metrics, of_mistakes;
  int docked = 0, felt = 0, safe = 0;
  DockingOutcome worst;
  double time_s = 0.0, felt_least_n = 1e9;
  for (int i = 0; i < seeds; ++i) {
    Trace trace = docking_trace(i == 0 ? run.out : std::filesystem::path(), "docking");
    const DockingOutcome o =
        dock(run.config, run.seed + static_cast<std::uint64_t>(i), DockingMistake::kNone, &trace);
    trace.close();
    docked += o.docked && o.felt_success && o.safe;
    felt += o.felt_success;
    safe += o.safe;
    time_s += o.latched_s / seeds;
    felt_least_n = std::min(felt_least_n, o.felt_success_n);
    worst.tool_force_max_n = std::max(worst.tool_force_max_n, o.tool_force_max_n);
    worst.target_speed_max_m_per_s = std::max(worst.target_speed_max_m_per_s, o.target_speed_max_m_per_s);
    worst.energy_created_j = std::max(worst.energy_created_j, o.energy_created_j);
    worst.port_energy_min_j = std::min(worst.port_energy_min_j, o.port_energy_min_j);
    report();
  }
  const double of_good_n = worst.tool_force_max_n;
  int mistakes_felt = 0, mistakes_safe = 0;
  for (int m = 1; m < kDockingMistakes; ++m) {
    const auto mistake = static_cast<DockingMistake>(m);
    const std::string name(to_string(mistake));
    Trace trace = docking_trace(run.out, "docking_" + name);
    const DockingOutcome o = dock(run.config, run.seed, mistake, &trace);
    trace.close();
    add(of_mistakes, name, o);
    worst.tool_force_max_n = std::max(worst.tool_force_max_n, o.tool_force_max_n);
    worst.target_speed_max_m_per_s = std::max(worst.target_speed_max_m_per_s, o.target_speed_max_m_per_s);
    mistakes_felt += o.felt_mistake_n >= kFeltLeast_n;
    mistakes_safe += o.safe;
    report();
  }
  metrics.push_back({"seeds", static_cast<double>(seeds), ""});
  metrics.push_back({"docked", static_cast<double>(docked), ""});
  metrics.push_back({"felt_success", static_cast<double>(felt), ""});
  metrics.push_back({"safe", static_cast<double>(safe), ""});
  metrics.push_back({"time_to_dock_s", time_s, "s, mean"});
  metrics.push_back({"felt_least_n", felt_least_n, "N, minimum over all seeds of the peak force rise"});
  metrics.push_back({"tool_force_max_n", worst.tool_force_max_n, "N, including mistakes"});
  metrics.push_back({"docked_tool_force_max_n", of_good_n, "N, without mistakes"});
  metrics.push_back({"target_speed_max_m_per_s", worst.target_speed_max_m_per_s, "m/s, including mistakes"});
  metrics.push_back({"energy_created_max_j", worst.energy_created_j, "J"});
  metrics.push_back({"port_energy_min_j", worst.port_energy_min_j, "J"});
  metrics.insert(metrics.end(), of_mistakes.begin(), of_mistakes.end());
  metrics.push_back({"mistakes", kDockingMistakes - 1.0, ""});
  metrics.push_back({"mistakes_felt", static_cast<double>(mistakes_felt), ""});
  metrics.push_back({"mistakes_safe", static_cast<double>(mistakes_safe), ""});
  return metrics;
}

}  // namespace longreach
