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

/// Results of several dockings.
struct Dockings {
  int docked = 0, felt_success = 0, felt_mistake = 0, safe = 0;
  double time_s = 0.0;  // sum
  double felt_success_least_n = 1e9, felt_mistake_least_n = 1e9;
  double pressed_max_n = 0.0, tool_force_max_n = 0.0, target_speed_max_m_per_s = 0.0;
  double energy_created_j = 0.0, port_energy_min_j = 0.0;

  void add(const DockingOutcome& o) {
    docked += o.docked && o.felt_success && o.safe;
    felt_success += o.felt_success;
    felt_mistake += o.felt_mistake_n >= kFeltLeast_n;
    safe += o.safe;
    time_s += o.latched_s;
    felt_success_least_n = std::min(felt_success_least_n, o.felt_success_n);
    felt_mistake_least_n = std::min(felt_mistake_least_n, o.felt_mistake_n);
    add_extremes({.pressed_max_n = o.pressed_max_n,
                  .tool_force_max_n = o.tool_force_max_n,
                  .target_speed_max_m_per_s = o.target_speed_max_m_per_s,
                  .energy_created_j = o.energy_created_j,
                  .port_energy_min_j = o.port_energy_min_j});
  }
  void add_extremes(const Dockings& other) {
    pressed_max_n = std::max(pressed_max_n, other.pressed_max_n);
    tool_force_max_n = std::max(tool_force_max_n, other.tool_force_max_n);
    target_speed_max_m_per_s = std::max(target_speed_max_m_per_s, other.target_speed_max_m_per_s);
    energy_created_j = std::max(energy_created_j, other.energy_created_j);
    port_energy_min_j = std::min(port_energy_min_j, other.port_energy_min_j);
  }
};

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
  const int seeds = campaign(30, 3), mistake_seeds = campaign(10, 1), kinds = kDockingMistakes - 1;
  const int runs = seeds + kinds * mistake_seeds;
  int done = 0;
  const auto dock_all = [&](DockingMistake mistake, int count) {
    const std::string name =
        mistake == DockingMistake::kNone ? "docking" : "docking_" + std::string(to_string(mistake));
    Dockings all;
    for (int i = 0; i < count; ++i) {
      Trace trace = docking_trace(i == 0 ? run.out : std::filesystem::path(), name);
      all.add(dock(run.config, run.seed + static_cast<std::uint64_t>(i), mistake, &trace));
      trace.close();
      if (run.progress) run.progress(static_cast<double>(++done) / runs);
    }
    return all;
  };
  const Dockings good = dock_all(DockingMistake::kNone, seeds);
  Dockings worst;
  worst.add_extremes(good);
  std::vector<Metric> of_mistakes;
  int felt = 0, safe = 0;
  for (int m = 1; m <= kinds; ++m) {
    const auto mistake = static_cast<DockingMistake>(m);
    const std::string name(to_string(mistake));
    const Dockings all = dock_all(mistake, mistake_seeds);
    worst.add_extremes(all);
    felt += all.felt_mistake;
    safe += all.safe;
    of_mistakes.push_back({name + "_felt_least_n", all.felt_mistake_least_n, "N"});
    of_mistakes.push_back({name + "_pressed_max_n", all.pressed_max_n, "N"});
    of_mistakes.push_back({name + "_tool_force_max_n", all.tool_force_max_n, "N"});
    of_mistakes.push_back({name + "_target_speed_max_m_per_s", all.target_speed_max_m_per_s, "m/s"});
    of_mistakes.push_back({name + "_safe", static_cast<double>(all.safe), ""});
  }
  std::vector<Metric> metrics{
      {"seeds", static_cast<double>(seeds), ""},
      {"docked", static_cast<double>(good.docked), ""},
      {"felt_success", static_cast<double>(good.felt_success), ""},
      {"safe", static_cast<double>(good.safe), ""},
      {"time_to_dock_s", good.time_s / seeds, "s, mean"},
      {"felt_least_n", good.felt_success_least_n, "N, minimum over all seeds of the peak force rise"},
      {"pressed_max_n", worst.pressed_max_n, "N, including mistakes"},
      {"docked_pressed_max_n", good.pressed_max_n, "N, without mistakes"},
      {"tool_force_max_n", worst.tool_force_max_n, "N, including mistakes and the inertia of the target"},
      {"target_speed_max_m_per_s", worst.target_speed_max_m_per_s, "m/s, including mistakes"},
      {"energy_created_max_j", worst.energy_created_j, "J"},
      {"port_energy_min_j", worst.port_energy_min_j, "J"}};
  // MuJoCo does not account for energy.
  if (!run.config.slave().robot().mjcf().empty())
    std::erase_if(metrics, [](const Metric& m) { return m.name == "energy_created_max_j"; });
  metrics.insert(metrics.end(), of_mistakes.begin(), of_mistakes.end());
  metrics.push_back({"mistakes", static_cast<double>(kinds * mistake_seeds), ""});
  metrics.push_back({"mistakes_felt", static_cast<double>(felt), ""});
  metrics.push_back({"mistakes_safe", static_cast<double>(safe), ""});
  return metrics;
}

}  // namespace longreach
