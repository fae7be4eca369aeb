// Is the displayed stiffness correct in every run? Runs the stiffness law with many seeds for every round
// trip and every named link without an outage, and for every wall and hand. The runs are independent and are
// distributed over all processors.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

struct Study {
  std::vector<proto::LinkProfile> links;
  std::vector<double> wall_n_per_m;
  std::vector<Grip> grips;
  int seeds = 1;

  [[nodiscard]] std::size_t runs() const {
    return links.size() * wall_n_per_m.size() * grips.size() * static_cast<std::size_t>(seeds);
  }
};

std::vector<proto::LinkProfile> named_links() {
  const std::filesystem::path deploy = find_deploy_folder();
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(deploy / "links"))
    names.push_back(file.path().stem().string());
  std::ranges::sort(names);
  std::vector<proto::LinkProfile> links;
  for (const std::string& name : names) {
    const proto::LinkProfile link = load_link_profile(deploy, name);
    if (link.up().blackout_duration_s() == 0.0 && link.down().blackout_duration_s() == 0.0)
      links.push_back(link);
  }
  return links;
}

Study study_of(const ExperimentRun& run) {
  const bool full = campaign(1, 0) == 1;
  const DelayGrid grid;
  Study study{.links = named_links(),
              .wall_n_per_m = full ? grid.wall_n_per_m : std::vector{200.0, 5000.0},
              .grips = grid.grips,
              .seeds = full ? 30 : 1};
  for (const double rtt_s : full ? grid.rtt_s : std::vector{0.0, 3.0}) {
    study.links.push_back(plain_link(run.config, rtt_s));
    study.links.back().set_name(short_number(rtt_s) + " s");
  }
  return study;
}

/// Each run has its own seed and its own place in the results, so that the result does not depend on the
/// scheduling.
std::vector<DelayResult> run_all(const ExperimentRun& run, const Study& study) {
  std::vector<DelayResult> results(study.runs());
  const auto one = [&](std::size_t i) {
    const auto seeds = static_cast<std::size_t>(study.seeds);
    const std::size_t wall = i / seeds, grip = wall / study.wall_n_per_m.size();
    ExperimentRun touch;
    touch.config = run.config;
    touch.seed = run.seed + i % seeds;
    results[i] = touch_across(touch, study.links[grip / study.grips.size()],
                              study.wall_n_per_m[wall % study.wall_n_per_m.size()],
                              study.grips[grip % study.grips.size()]);
  };
  on_all_cores(results.size(), one, run.progress);
  return results;
}

DelaySeeds summary_of(const std::vector<DelayResult>& results) {
  DelaySeeds all;
  for (const DelayResult& r : results) {
    (r.grip == Grip::kReleased ? all.released : all.held).add(r);
    all.estimate_sd_max = std::max(all.estimate_sd_max, r.estimate_sd);
  }
  return all;
}

/// Writes all results in the order of the runs.
void write_runs(const ExperimentRun& run, const Study& study, const std::vector<DelayResult>& results) {
  Trace trace(run.out, "runs",
              {"rtt_s", "grip", "wall_n_per_m", "seed", "displayed_n_per_m", "error", "estimate_sd",
               "limit_cycle", "motion_m", "port_energy_min_j", "drawdown_j"});
  for (std::size_t i = 0; i < results.size(); ++i) {
    const DelayResult& r = results[i];
    trace.row({r.rtt_s, static_cast<double>(r.grip), r.wall_n_per_m,
               static_cast<double>(run.seed + i % static_cast<std::size_t>(study.seeds)),
               r.found.displayed_n_per_m, r.error, r.estimate_sd, r.found.limit_cycle ? 1.0 : 0.0,
               r.found.motion_m, r.found.port_energy_min_j, r.found.drawdown_j});
  }
  trace.close();
}

/// One row per link and one column per wall: the worst error over light and firm hands and all seeds, in
/// percent.
void write_worst(const ExperimentRun& run, const std::vector<DelayResult>& results) {
  std::map<double, std::map<double, DelayResult>> worst;  // by round trip, by wall
  for (const DelayResult& r : results) {
    if (r.grip == Grip::kReleased) continue;
    DelayResult& w = worst[r.rtt_s][r.wall_n_per_m];
    w.error = std::max(w.error, r.error);
    w.estimate_sd = std::max(w.estimate_sd, r.estimate_sd);
  }
  Trace trace(run.out, "delay_seeds",
              {"rtt_s", "error_200_percent", "error_500_percent", "error_1000_percent", "error_5000_percent",
               "sd_200_percent", "sd_500_percent", "sd_1000_percent", "sd_5000_percent",
               "error_bound_percent", "sd_bound_percent"});
  for (auto& [rtt_s, at] : worst) {
    const auto error = [&at](double wall) { return at.contains(wall) ? 100.0 * at[wall].error : NAN; };
    const auto sd = [&at](double wall) { return at.contains(wall) ? 100.0 * at[wall].estimate_sd : NAN; };
    trace.row({rtt_s, error(200), error(500), error(1000), error(5000), sd(200), sd(500), sd(1000), sd(5000),
               5.0, 1.0});
  }
  trace.close();
}

}  // namespace

std::vector<Plot> delay_seeds_plots() {
  Panel error{"maximum error (%)", {}, "set xrange [-0.2:7.2]\nset yrange [0:6]"};
  Panel sd{"maximum sd of the estimate (%)", {}, "set xrange [-0.2:7.2]\nset yrange [0:1.2]"};
  for (const char* wall : {"200", "500", "1000", "5000"}) {
    const std::string title = std::to_string(std::stod(wall) / 1000.0).substr(0, 3) + " N/mm";
    error.curves.push_back(
        {.column = std::string("error_") + wall + "_percent", .title = title, .points = true});
    sd.curves.push_back({.column = std::string("sd_") + wall + "_percent", .title = title, .points = true});
  }
  error.curves.push_back({.column = "error_bound_percent", .title = "bound"});
  sd.curves.push_back({.column = "sd_bound_percent", .title = "bound"});
  return {{.name = "delay_seeds",
           .csv = "delay_seeds",
           .title = "Displayed stiffness: maximum error over all seeds, light and firm hands",
           .x_column = "rtt_s",
           .x_label = "round-trip time (s), fixed delays and named links",
           .panels = {error, sd}}};
}

std::size_t delay_seeds_slices(const ExperimentRun& run) {
  const Study study = study_of(run);
  return study.links.size() * study.wall_n_per_m.size();
}

DelaySeeds delay_seeds_slice(const ExperimentRun& run, std::size_t slice) {
  Study study = study_of(run);
  const std::size_t walls = study.wall_n_per_m.size();
  study.links = {study.links.at(slice / walls)};
  study.wall_n_per_m = {study.wall_n_per_m[slice % walls]};
  DelaySeeds found = summary_of(run_all(run, study));
  found.link = study.links.front().name();
  found.wall_n_per_m = study.wall_n_per_m.front();
  return found;
}

std::vector<Metric> run_delay_seeds(const ExperimentRun& run) {
  const Study study = study_of(run);
  const std::vector<DelayResult> results = run_all(run, study);
  const auto [link, wall, held, released, sd_max] = summary_of(results);
  if (!run.out.empty()) {
    write_runs(run, study, results);
    write_worst(run, results);
  }
  if (run.progress) run.progress(1.0);
  return {{"links", static_cast<double>(study.links.size()), ""},
          {"seeds", static_cast<double>(study.seeds), ""},
          {"held_runs", static_cast<double>(held.cases), ""},
          {"held_within_5_percent", static_cast<double>(held.right), ""},
          {"displayed_error_max", held.error_max, ""},
          {"estimate_sd_max", sd_max, ""},
          {"held_limit_cycles", static_cast<double>(held.limit_cycles), ""},
          {"released_runs", static_cast<double>(released.cases), ""},
          {"released_limit_cycles", static_cast<double>(released.limit_cycles), ""},
          {"port_energy_min_j", std::min(held.port_energy_min_j, released.port_energy_min_j), "J"},
          {"drawdown_max_j", std::max(held.drawdown_max_j, released.drawdown_max_j), "J"}};
}

}  // namespace longreach
