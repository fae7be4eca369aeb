// Free motion with unknown sensors, one hour in total at full size, each followed by the touch of a wall.
// Then the same with a configured threshold.

#include <algorithm>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/free_motion.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kInTime_s = 0.05;
constexpr double kFixed_n = 0.3;

struct Motions {
  std::vector<FreeMotionCell> cells;
  std::vector<FreeMotionResult> results;

  template <class Value>
  [[nodiscard]] double sum(Value value) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) sum += static_cast<double>(value(results[i]));
    return sum;
  }
  template <class Value>
  [[nodiscard]] double most(Value value) const {
    double most = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) most = std::max(most, value(results[i]));
    return most;
  }
};

int false_contacts(const FreeMotionResult& r) { return r.false_contacts; }
bool in_time(const FreeMotionResult& r) { return r.found && r.found_s <= kInTime_s; }

void write(const ExperimentRun& run, const std::vector<const Motions*>& all) {
  Trace trace(run.out, "motions",
              {"noise_n", "bias_n", "mass_kg", "mass_error", "gravity", "configured_touch_n", "speed_m_per_s",
               "stiffness_n_per_m", "moved_s", "false_contacts", "false_s", "touch_n", "found", "found_s",
               "found_n"});
  for (const Motions* motions : all) {
    for (std::size_t i = 0; i < motions->cells.size(); ++i) {
      const FreeMotionCell& c = motions->cells[i];
      const FreeMotionResult& r = motions->results[i];
      trace.row({c.noise_n, c.bias_n, c.mass_kg, c.mass_error, c.gravity ? 1.0 : 0.0, c.touch_n,
                 c.speed_m_per_s, c.stiffness_n_per_m, r.moved_s, static_cast<double>(r.false_contacts),
                 r.false_s, r.touch_n, r.found ? 1.0 : 0.0, r.found_s, r.found_n});
    }
  }
  trace.close();
}

}  // namespace

std::vector<Plot> free_motion_plots() {
  return {{.name = "free-motion",
           .csv = "motions",
           .title = "Unknown force sensors: derived touch thresholds and detected walls",
           .x_column = "noise_n",
           .x_label = "noise per sample and axis (N)",
           .panels = {{"touch threshold (N)",
                       {{.column = "touch_n", .title = "sensor", .points = true}},
                       "set logscale x"},
                      {"force at wall detection (N)",
                       {{.column = "found_n", .title = "wall", .points = true}},
                       "set logscale x"}}}};
}

std::vector<Metric> run_free_motion_study(const ExperimentRun& run) {
  const auto sensors = static_cast<std::size_t>(campaign(45, 12)),
             slow = static_cast<std::size_t>(campaign(15, 4));
  Motions usual, slowly, fixed;
  Random random = Random(run.seed).child("free-motion");
  for (std::size_t i = 0; i < sensors; ++i) usual.cells.push_back(draw_free_motion(random, false));
  for (std::size_t i = 0; i < slow; ++i) slowly.cells.push_back(draw_free_motion(random, true));
  fixed.cells.resize(2);
  for (FreeMotionCell& cell : fixed.cells) {
    cell.noise_n = 0.5;
    cell.touch_n = kFixed_n;
  }
  for (Motions* all : {&usual, &slowly, &fixed}) {
    all->results.resize(all->cells.size());
    on_all_cores(
        all->cells.size(),
        [&](std::size_t i) {
          ExperimentRun one;
          one.config = run.config;
          one.seed = run.seed + i;
          all->results[i] = run_free_motion(one, all->cells[i]);
        },
        all == &usual ? run.progress : nullptr);
  }
  write(run, {&usual, &slowly, &fixed});
  const auto moved = [](const FreeMotionResult& r) { return r.moved_s; };
  return {
      {"sensors", static_cast<double>(sensors + slow), ""},
      {"moved_s", usual.sum(moved) + slowly.sum(moved), "s"},
      {"false_contacts", usual.sum(false_contacts) + slowly.sum(false_contacts), ""},
      {"walls", static_cast<double>(sensors), ""},
      {"walls_found", usual.sum(in_time), ""},
      {"wall_found_max_s", usual.most([](const FreeMotionResult& r) { return r.found_s; }), "s"},
      {"slow_walls", static_cast<double>(slow), ""},
      {"slow_walls_found", slowly.sum([](const FreeMotionResult& r) { return r.found; }), ""},
      {"slow_wall_max_n", slowly.most([](const FreeMotionResult& r) { return r.found_n; }), "N"},
      {"touch_max_n",
       std::max(usual.most([](const FreeMotionResult& r) { return r.touch_n; }),
                slowly.most([](const FreeMotionResult& r) { return r.touch_n; })),
       "N"},
      {"fixed_false_contacts", fixed.sum(false_contacts), ""},
  };
}

}  // namespace longreach
