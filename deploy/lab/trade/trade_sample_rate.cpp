// The sample rate of the master against the maximum stiffness that can then be rendered, from the exact model
// of the sampled wall for the three grips, and the cost of the ticks on this machine.

#include "common/config/config.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"
#include "master/master_node.hpp"

namespace longreach {
namespace {

constexpr double kRates_hz[] = {250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0};
constexpr double kStandard_hz = LoopConfig{}.rate_hz;
constexpr std::pair<const char*, Grip> kGrips[] = {
    {"light_hand", Grip::kLight}, {"firm_hand", Grip::kFirm}, {"released", Grip::kReleased}};
constexpr double kPress_n = 10.0;

/// Cost of a tick of the master, including the device, ns.
double tick_ns(const MasterConfig& config) {
  MasterNode node(config);
  node.render_by(contact_law(config.rendering.law));
  SimulatedDevices devices(config.device);
  MasterInput input;
  return cost_ns(2000, [&](int) {
    input.now += std::chrono::milliseconds(1);
    input.handle = devices.read(input.now);
    node.step(input);
  });
}

std::vector<TradePoint> measure_sample_rate(const ExperimentRun& run) {
  const MasterConfig master = to_struct(run.config.master());
  const double ns = tick_ns(master);
  std::vector<TradePoint> points;
  for (const auto& [name, grip] : kGrips) {
    for (const double hz : kRates_hz) {
      const WallCase c{ideal_device(master.device), grip, 1.0 / hz, 1.0};
      const double give_mm = 1e3 * kPress_n / exact_limit_n_per_m(model_of(c));
      points.push_back({name, std::to_string(std::lround(hz)) + "hz", 1e-3 * ns * hz, give_mm});
      points.back().standard = hz == kStandard_hz;
    }
  }
  return points;
}

}  // namespace

TradeStage trade_sample_rate() {
  return {.name = "sample_rate",
          .title = "250 to 8000 ticks per second, and the maximum displayed stiffness",
          .cost = "computing time of the master per second",
          .cost_unit = "µs",
          .error = "deflection of the stiffest wall under 10 N",
          .error_unit = "mm",
          .series = {"light_hand", "firm_hand", "released"},
          .measure = measure_sample_rate};
}

}  // namespace longreach
