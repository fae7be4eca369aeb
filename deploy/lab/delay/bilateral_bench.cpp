#include "deploy/lab/delay/bilateral_bench.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

DelayLineConfig way(const BilateralCase& c, int delay_samples) {
  return {.samples = delay_samples, .jitter_samples = c.jitter_s / kBenchPeriod_s, .loss = c.loss};
}

}  // namespace

Coupling make_coupling(RenderingLaw law, const ComparisonConfig& config) {
  switch (law) {
    case RenderingLaw::kPositionPosition:
      return SpringCoupling(config);
    case RenderingLaw::kWave:
      return WaveCoupling(config);
    case RenderingLaw::kTdpa:
      return PassivityCoupling(config);
    case RenderingLaw::kTank:
      return TankCoupling(config);
    default:
      return FollowCoupling{};
  }
}

BilateralBench::BilateralBench(const BilateralCase& c)
    : case_(c),
      hand_(hand_model(c.grip)),
      device_(c.device),
      handle_(c.device),
      law_(make_comparison_law(c.law, c.config)),
      coupling_(make_coupling(c.law, c.config)),
      up_(way(c, bench_samples(c.rtt_s) / 2), Random(c.seed).child("up")),
      down_(way(c, bench_samples(c.rtt_s) - bench_samples(c.rtt_s) / 2), Random(c.seed).child("down")) {}

double BilateralBench::wall_energy_j() const {
  const double p = std::max(0.0, tool_depth_m());
  return 0.5 * case_.wall_n_per_m * p * p;
}

/// Runs both sides and the link for one sample with the present position of the handle.
void BilateralBench::communicate() {
  const Vector3 wall_n(0.0, 0.0, case_.wall_n_per_m * std::max(0.0, tool_depth_m()));
  const CouplingOutput far =
      longreach::step(coupling_, {.command = up_.pop(), .force_n = wall_n}, kBenchPeriod_s);
  tool_m_ = far.setpoint_m;
  down_.push(far.report);

  handle_.read(device_.encoder_rad(), 0.0);
  const Vector3 moved_m = handle_.position_m() - handle_m_;
  handle_m_ = handle_.position_m();
  port_j_ -= force_n_.dot(moved_m);
  const ComparisonOutput out = longreach::step(
      law_, {.position_m = handle_m_, .velocity_m_per_s = moved_m / kBenchPeriod_s, .report = down_.pop()},
      kBenchPeriod_s);
  force_n_ = out.force_n;
  up_.push(out.command);
}

void BilateralBench::step(double hand_depth_m, double press_n) {
  communicate();
  device_.command(handle_.torques(force_n_ - Vector3(0.0, 0.0, press_n)));
  device_.step(kBenchPeriod_s, hand_, {0.0, 0.0, -hand_depth_m}, Vector3::Zero());
}

void BilateralBench::settle(double depth_m, double from_m) {
  device_.place({0.0, 0.0, -depth_m});
  for (int i = 0; i < bench_samples(case_.rtt_s) + bench_samples(1.0); ++i) communicate();
  device_.place({0.0, 0.0, -from_m});
}

}  // namespace longreach
