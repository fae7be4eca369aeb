// Drags loads of unknown mass (200 at full size), lets loads of 5 kg touch a wall before and after their mass
// is known, and closes an empty gripper.

#include <algorithm>
#include <cmath>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/drag.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kStop_m = 1e-3;  // maximum distance from the position with an empty gripper
/// Maximum error of the mass where the inertial force is well above the noise.
constexpr double kMass = 0.05;
constexpr double kWell = 20.0;  // inertial force that counts as well above the noise, relative to it
constexpr double kFound_s = 0.05;

struct Loads {
  std::vector<DragCell> cells;
  std::vector<DragResult> results;

  template <class Predicate>
  [[nodiscard]] double count(Predicate p) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) sum += p(cells[i], results[i]) ? 1.0 : 0.0;
    return sum;
  }
  template <class Value>
  [[nodiscard]] double most(Value value) const {
    double most = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) most = std::max(most, value(cells[i], results[i]));
    return most;
  }
};

bool reported(const DragCell&, const DragResult& r) { return r.reported_sd_kg > 0.0; }
double mass_error(const DragCell& c, const DragResult& r) {
  return std::abs(r.reported_kg / c.mass_kg - 1.0);
}
bool well(const DragCell& c, const DragResult& r) { return r.push_n >= kWell * c.noise_n; }

void write(const ExperimentRun& run, const std::string& name, const Loads& loads) {
  Trace trace(run.out, name,
              {"mass_kg", "speed_m_per_s", "acceleration_m_per_s2", "noise_n", "rate_mode", "held", "moved",
               "phantoms", "holds", "overrun_m", "push_n", "told_kg", "told_sd_kg", "told_s", "found_s",
               "mass_error_percent"});
  for (std::size_t i = 0; i < loads.cells.size(); ++i) {
    const DragCell& c = loads.cells[i];
    const DragResult& r = loads.results[i];
    trace.row({c.mass_kg, c.speed_m_per_s, c.acceleration_m_per_s2, c.noise_n,
               c.mode == MotionMode::kRate ? 1.0 : 0.0, r.held ? 1.0 : 0.0, r.moved ? 1.0 : 0.0,
               static_cast<double>(r.phantoms), static_cast<double>(r.holds), r.overrun_m, r.push_n,
               r.reported_kg, r.reported_sd_kg, r.reported_s, r.found_s,
               c.mass_kg > 0.0 ? 100.0 * (r.reported_kg / c.mass_kg - 1.0) : 0.0});
  }
  trace.close();
}

std::vector<Metric> of_loads(const Loads& loads) {
  return {
      {"drags", static_cast<double>(loads.cells.size()), ""},
      {"dragged", loads.count([](const DragCell&, const DragResult& r) { return r.held && r.moved; }), ""},
      {"phantom_contacts", loads.count([](const DragCell&, const DragResult& r) { return r.phantoms > 0; }),
       ""},
      {"holds", loads.count([](const DragCell&, const DragResult& r) { return r.holds > 0; }), ""},
      {"stopped_as_without_load",
       loads.count([](const DragCell&, const DragResult& r) { return r.overrun_m <= kStop_m; }), ""},
      {"overrun_max_m", loads.most([](const DragCell&, const DragResult& r) { return r.overrun_m; }), "m"},
      {"push_max_n", loads.most([](const DragCell&, const DragResult& r) { return r.push_n; }), "N"},
      {"mass_told", loads.count(reported), ""},
      {"mass_within_3_sd", loads.count([](const DragCell& c, const DragResult& r) {
         return reported(c, r) && std::abs(r.reported_kg - c.mass_kg) <= 3.0 * r.reported_sd_kg;
       }),
       ""},
      {"mass_above_noise", loads.count(well), ""},
      {"mass_within_5_percent", loads.count([](const DragCell& c, const DragResult& r) {
         return well(c, r) && reported(c, r) && mass_error(c, r) <= kMass;
       }),
       ""},
      {"mass_error_max",
       loads.most([](const DragCell& c, const DragResult& r) { return well(c, r) ? mass_error(c, r) : 0.0; }),
       ""},
  };
}

void add_walls(std::vector<Metric>& metrics, const std::string& prefix, const Loads& met) {
  const auto found = [](const DragCell&, const DragResult& r) {
    return r.held && r.found_s > 0.0 && r.found_s <= kFound_s && r.phantoms == 0;
  };
  metrics.push_back({prefix + "walls", static_cast<double>(met.cells.size()), ""});
  metrics.push_back({prefix + "walls_found", met.count(found), ""});
  metrics.push_back({prefix + "wall_found_max_s",
                     met.most([](const DragCell&, const DragResult& r) { return r.found_s; }), "s"});
}

std::vector<Metric> of_nothing(const Loads& nothing) {
  return {
      {"closed_on_nothing", static_cast<double>(nothing.cells.size()), ""},
      {"nothing_told", nothing.count([](const DragCell&, const DragResult& r) {
         return !r.held && r.phantoms == 0 && r.reported_kg == 0.0;
       }),
       ""},
  };
}

}  // namespace

std::vector<Plot> drag_plots() {
  return {{.name = "drag",
           .csv = "loads",
           .title = "Identified mass of unknown loads while they are dragged",
           .x_column = "mass_kg",
           .x_label = "mass of the load (kg)",
           .panels = {{"mass error (%)",
                       {{.column = "mass_error_percent", .title = "load", .points = true}},
                       "set logscale x\nset yrange [-20:20]"},
                      {"shift of the stopping point relative to that with an empty gripper (mm)",
                       {{.column = "overrun_m", .title = "load", .factor = 1e3, .points = true}},
                       "set logscale x"}}}};
}

std::vector<Metric> run_drag_study(const ExperimentRun& run) {
  const auto drags = static_cast<std::size_t>(campaign(200, 10));
  const auto walls = static_cast<std::size_t>(campaign(12, 4)),
             empty = static_cast<std::size_t>(campaign(6, 2));
  Loads loads, met, met_known, nothing;
  Random random = Random(run.seed).child("drag");
  for (std::size_t i = 0; i < drags; ++i) loads.cells.push_back(draw_drag(random));
  for (std::size_t i = 0; i < walls; ++i) {
    DragCell cell = draw_drag(random);
    cell.mass_kg = 5.0;
    cell.speed_m_per_s = 0.01;
    cell.acceleration_m_per_s2 = 1.25;
    cell.noise_n = 0.05;
    cell.wall = true;
    met.cells.push_back(cell);
    cell.known = true;
    met_known.cells.push_back(cell);
  }
  for (std::size_t i = 0; i < empty; ++i) {
    DragCell cell = draw_drag(random);
    cell.mass_kg = 0.0;
    nothing.cells.push_back(cell);
  }
  for (Loads* all : {&loads, &met, &met_known, &nothing}) {
    all->results.resize(all->cells.size());
    on_all_cores(
        all->cells.size(),
        [&](std::size_t i) {
          ExperimentRun one;
          one.config = run.config;
          one.seed = run.seed + i;
          all->results[i] = run_drag(one, all->cells[i]);
        },
        all == &loads ? run.progress : nullptr);
  }
  write(run, "loads", loads);
  write(run, "walls", met);
  write(run, "known_walls", met_known);
  std::vector<Metric> metrics = of_loads(loads);
  add_walls(metrics, "", met);
  add_walls(metrics, "known_", met_known);
  for (Metric& m : of_nothing(nothing)) metrics.push_back(std::move(m));
  return metrics;
}

}  // namespace longreach
