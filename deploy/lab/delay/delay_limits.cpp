#include "deploy/lab/delay/delay_limits.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "deploy/lab/devices/wall_bench.hpp"

namespace longreach {
namespace {

constexpr double kPress_n = 0.2;      // initial disturbance of the handle in the wall
constexpr double kDeepest_m = 0.005;  // depth at rest, small because the linear model is valid near home

bool dies_away(BilateralCase c, double stiffness_n_per_m) {
  c.wall_n_per_m = stiffness_n_per_m;
  BilateralBench bench(c);
  const double rest_m = std::min(kPress_n / stiffness_n_per_m, kDeepest_m);
  bench.settle(rest_m, 1.01 * rest_m);
  const int end = bench_samples(5.0 + 40.0 * c.rtt_s);
  double middle_m = 0.0, late_m = 0.0;
  for (int i = 0; i < end; ++i) {
    bench.step(rest_m, stiffness_n_per_m * rest_m);
    const double off_m = std::abs(bench.depth_m() - rest_m);
    if (i > end / 4 && i <= end / 2) middle_m = std::max(middle_m, off_m);
    if (i > 3 * end / 4) late_m = std::max(late_m, off_m);
    if (off_m > rest_m) return false;  // out of contact
  }
  return late_m <= middle_m;
}

}  // namespace

HeldHandle held_handle(const DeviceConfig& device, Grip grip) {
  const SampledWall m = model_of({.device = device, .grip = grip});
  return {m.mass_kg, m.device_n_s_per_m + m.hand_n_s_per_m, m.hand_n_per_m};
}

DeviceConfig ideal_handle(const DeviceConfig& device, double mass_kg, double n_s_per_m) {
  DeviceConfig out = ideal_device(device);
  out.delta.platform_kg += mass_kg - held_handle(out, Grip::kReleased).mass_kg;
  return with_damping(out, n_s_per_m);
}

double direct_limit_n_per_m(const HeldHandle& h, double loop_delay_s) {
  const auto plant = [&](double w) {
    return std::complex<double>(h.n_per_m - h.mass_kg * w * w, h.n_s_per_m * w);
  };
  const auto turns = [&](double w) {
    return (w * loop_delay_s + std::arg(plant(w)) - std::numbers::pi) / (2.0 * std::numbers::pi);
  };
  // The crossings are about 2π/τ apart. Above the resonance |plant| increases monotonically.
  const double resonance = std::sqrt(h.n_per_m / h.mass_kg);
  const double end = 2.0 * resonance + 4.0 * std::numbers::pi / loop_delay_s;
  constexpr int kSteps = 20000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= kSteps; ++i) {
    double low = end * (i - 1) / kSteps, high = end * i / kSteps;
    if (i == 1) low = 1e-9 * end;
    const double crossing = std::ceil(turns(low));
    if (turns(high) < crossing) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (turns(middle) < crossing ? low : high) = middle;
    }
    least = std::min(least, std::abs(plant(high)));
  }
  return least;
}

double position_position_limit_n_per_m(double master_n_s_per_m, double slave_n_s_per_m, double rtt_s) {
  return std::sqrt(8.0 * master_n_s_per_m * slave_n_s_per_m) / rtt_s;
}

double measured_direct_limit_n_per_m(const BilateralCase& c, double most_n_per_m, double tolerance) {
  if (dies_away(c, most_n_per_m)) return most_n_per_m;
  double low = 0.1, high = most_n_per_m;
  // Searches from above in factors of two, because unstable runs end early.
  while (high > 2.0 * low && !dies_away(c, 0.5 * high)) high *= 0.5;
  low = std::max(low, 0.5 * high);
  while (high > (1.0 + tolerance) * low) {
    const double middle = std::sqrt(low * high);
    (dies_away(c, middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace longreach
