// Figure 18 of Liu et al. 2019: the maximum stiffness of a virtual wall of the translational device as a
// function of sample time, hand, delay, encoders and friction.

#include <array>
#include <string>
#include <utility>

#include "common/config/config.hpp"
#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/devices/delta/delta_dynamics.hpp"

namespace longreach {
namespace {

constexpr std::array kPeriods_s = {0.25e-3, 0.5e-3, 1e-3, 1.5e-3, 2e-3, 2.5e-3};
constexpr std::array kGrips = {Grip::kLight, Grip::kFirm, Grip::kReleased};
constexpr std::array<const char*, 3> kGripNames = {"light", "firm", "released"};
constexpr double kWallDamping_n_s_per_m = 1.0;
constexpr double kLittleDamping_n_s_per_m = 0.5;
constexpr double kTap_m = 2e-4;
constexpr double kTrembling_m = 1e-5;  // motion that a hand can just notice
constexpr double kPaper_n_per_m = 5000.0;

/// Simulated and exact limits over the sample time. Returns the largest relative difference.
double sweep_period(const ExperimentRun& run, const DeviceConfig& device) {
  Trace trace(run.out, "limits",
              {"period_s", "light_n_per_m", "light_exact_n_per_m", "light_formula_n_per_m", "firm_n_per_m",
               "firm_exact_n_per_m", "firm_formula_n_per_m", "released_n_per_m", "released_exact_n_per_m",
               "released_formula_n_per_m", "delayed_n_per_m", "delayed_exact_n_per_m",
               "delayed_formula_n_per_m", "passive_n_per_m", "paper_n_per_m"});
  double worst = 0.0;
  for (std::size_t p = 0; p < kPeriods_s.size(); ++p) {
    std::array<double, 15> row{};
    row[0] = kPeriods_s[p];
    WallCase c{ideal_device(device), Grip::kLight, kPeriods_s[p], kWallDamping_n_s_per_m};
    for (std::size_t g = 0; g <= kGrips.size(); ++g) {
      // The last case: released, with torques that are delayed by one sample.
      c.grip = kGrips[std::min(g, kGrips.size() - 1)];
      c.device.delay_samples = g == kGrips.size() ? 1 : 0;
      const SampledWall model = model_of(c);
      row[1 + 3 * g] = simulated_limit_n_per_m(c);
      row[2 + 3 * g] = exact_limit_n_per_m(model);
      row[3 + 3 * g] = formula_limit_n_per_m(model);
      row[13] = passive_limit_n_per_m(model);
      worst = std::max(worst, std::abs(row[1 + 3 * g] / row[2 + 3 * g] - 1.0));
    }
    row[14] = kPaper_n_per_m;
    trace.row({row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], row[10],
               row[11], row[12], row[13], row[14]});
    if (run.progress) run.progress(0.6 * static_cast<double>(p + 1) / kPeriods_s.size());
  }
  trace.close();
  return worst;
}

/// Maximum stiffness whose residual motion cannot be felt, by bisection to 3 %.
double stable_limit_n_per_m(const WallCase& c) {
  double low = 100.0, high = 200.0;
  const auto stable = [&](double K) { return residual_m(c, K, kTap_m) < kTrembling_m; };
  while (high < 2e5 && stable(high)) low = std::exchange(high, 2.0 * high);
  while (high > 1.03 * low) {
    const double middle = std::sqrt(low * high);
    (stable(middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Encoders and Coulomb friction, released handle.
void sweep_encoder(const ExperimentRun& run, const DeviceConfig& device) {
  Trace trace(run.out, "encoders",
              {"count_m", "smooth_n_per_m", "dry_n_per_m", "drier_n_per_m", "dry_line_n_per_m",
               "drier_line_n_per_m"});
  const DeltaDynamics d(device.delta);
  const double reach_m = 1.0 / d.pose(d.home_m()).rates.col(2).norm() * std::sqrt(3.0);  // of a leg, m/rad
  for (const double count_m : {2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4}) {
    std::array<double, 3> limit{}, line{};
    for (std::size_t i = 0; i < 3; ++i) {
      WallCase c{ideal_device(device), Grip::kReleased, 1e-3, 0.0};
      c.device = with_damping(c.device, kLittleDamping_n_s_per_m);
      c.device.delta.drive.resolution_rad = count_m / reach_m;
      c.device.delta.drive.coulomb_nm = std::array{0.0, 0.01, 0.03}[i];
      limit[i] = stable_limit_n_per_m(c);
      const double friction_n = 3.0 * c.device.delta.drive.coulomb_nm / reach_m;
      line[i] = 2.0 * friction_n / count_m;
    }
    trace.row({count_m, limit[0], limit[1], limit[2], line[1], line[2]});
  }
  trace.close();
}

}  // namespace

std::vector<Plot> wall_translation_plots() {
  const auto panel = [](const char* label, const std::string& key) {
    return Panel{label,
                 {{key + "_n_per_m", "simulated", 1e-3, true},
                  {key + "_exact_n_per_m", "exact model", 1e-3},
                  {key + "_formula_n_per_m", "(b + B)/(T/2 + t_d)", 1e-3},
                  {"passive_n_per_m", "passive", 1e-3},
                  {"paper_n_per_m", "5 N/mm", 1e-3}},
                 "set logscale y"};
  };
  return {{.name = "limits",
           .csv = "limits",
           .title = "Maximum stable stiffness versus sample time (no Coulomb friction, ideal encoders)",
           .x_column = "period_s",
           .x_label = "sample time (ms)",
           .x_factor = 1e3,
           .panels = {panel("light hand (N/mm)", "light"), panel("firm hand (N/mm)", "firm"),
                      panel("released (N/mm)", "released"), panel("released, 1 sample delay", "delayed")}},
          {.name = "encoders",
           .csv = "encoders",
           .title = "Maximum stable stiffness (up to 200 N/mm) versus the size of an encoder count (1 "
                    "kHz, released, 0.5 N s/m)",
           .x_column = "count_m",
           .x_label = "size of one count at the handle (µm)",
           .x_factor = 1e6,
           .panels = {{"stiffness (N/mm)",
                       {{"smooth_n_per_m", "no friction", 1e-3},
                        {"dry_n_per_m", "10 mN m per motor", 1e-3},
                        {"drier_n_per_m", "30 mN m per motor", 1e-3},
                        {"dry_line_n_per_m", "2 f_c/count, 10 mN m", 1e-3},
                        {"drier_line_n_per_m", "2 f_c/count, 30 mN m", 1e-3}},
                       "set logscale xy"}}}};
}

std::vector<Metric> run_wall_translation(const ExperimentRun& run) {
  const DeviceConfig device = to_struct(run.config.master()).device;
  std::vector<Metric> metrics;
  metrics.push_back({"limit_difference_max", sweep_period(run, device), ""});
  sweep_encoder(run, device);
  if (run.progress) run.progress(0.9);

  // The paper's 5 N/mm at 1 kHz, with the damping that makes it passive according to the limit.
  for (std::size_t g = 0; g < kGrips.size(); ++g) {
    WallCase c{with_damping(ideal_device(device), 0.5 * kPaper_n_per_m * 1e-3), kGrips[g], 1e-3, 0.0};
    metrics.push_back(
        {std::string("paper_wall_stable_") + kGripNames[g], decays(c, kPaper_n_per_m) ? 1.0 : 0.0, ""});
    metrics.push_back({std::string("paper_wall_limit_") + kGripNames[g], simulated_limit_n_per_m(c), "N/m"});
  }
  for (const double share : {0.5, 0.9, 1.1, 2.0}) {
    const WallCase c{with_damping(ideal_device(device), share * 0.5 * kPaper_n_per_m * 1e-3), Grip::kReleased,
                     1e-3, 0.0};
    const int percent = static_cast<int>(std::lround(100.0 * share));
    metrics.push_back({"cycle_energy_at_" + std::to_string(percent) + "_percent_of_passive_damping",
                       cycle_energy_j(c, kPaper_n_per_m), "J"});
  }
  if (run.progress) run.progress(1.0);
  return metrics;
}

}  // namespace longreach
