// Settings of the link: the send rate of commands, the playout delay for a smooth goal, and the deadband of
// the stiffness reports, over `analog` (0.85 s, 20 ms jitter, 1.5 % loss) unless the run names another link.

#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/trade/tracking.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {
namespace {

struct Variant {
  std::string series, setting;
  std::vector<std::string> settings;  // PATH=VALUE
  bool standard = false;
};

std::vector<TradePoint> measure_send_rate(const ExperimentRun& run) {
  std::vector<TradePoint> points;
  for (const auto& [series, playout] : {std::pair{"adaptive_playout", "playout.adaptive=true"},
                                        std::pair{"fixed_20_ms", "playout.adaptive=false"}}) {
    for (const int hz : {50, 100, 200, 300, 500, 1000}) {
      const Tracking t = track(run, {playout, "link.send_hz=" + std::to_string(hz)});
      points.push_back({series, std::to_string(hz) + "hz", t.kbit_per_s, 1e3 * t.bent_rms_m});
      points.back().standard = hz == std::lround(MasterLinkConfig{}.send_hz) && series[0] == 'a';
    }
  }
  return points;
}

std::vector<TradePoint> measure_playout(const ExperimentRun& run) {
  std::vector<TradePoint> points;
  for (const int ms : {0, 5, 10, 20, 50, 100}) {
    const Tracking t =
        track(run, {"playout.adaptive=false", "playout.fixed_delay_s=" + std::to_string(1e-3 * ms)});
    points.push_back({"fixed", std::to_string(ms) + "ms", 1e3 * t.late_s, t.roughness_m_per_s2});
  }
  for (const char* quantile : {"0.5", "0.9", "0.99", "0.999"}) {
    const Tracking t = track(run, {std::string("playout.quantile=") + quantile});
    points.push_back({"adaptive", quantile, 1e3 * t.late_s, t.roughness_m_per_s2});
    points.back().standard = std::string_view(quantile) == "0.9";
  }
  return points;
}

std::vector<TradePoint> measure_deadband(const ExperimentRun& run) {
  std::vector<TradePoint> points;
  for (const char* deadband : {"0.005", "0.02", "0.04", "0.08", "0.16", "0.3"}) {
    const Touched t =
        touched(run, {std::string("estimator.deadband=") + deadband, "scene.material.wall.exponent=1.5"});
    points.push_back({"deadband", deadband, t.return_bit_per_s, 100.0 * t.stiffness_error});
    points.back().standard = std::string_view(deadband) == "0.08";
  }
  return points;
}

}  // namespace

TradeStage trade_send_rate() {
  return {.name = "send_rate",
          .title = "50 to 1000 commands per second",
          .cost = "data rate of the commands",
          .cost_unit = "kbit/s",
          .error = "rms tracking error of the tool",
          .error_unit = "mm",
          .of_machine = false,
          .series = {"adaptive_playout", "fixed_20_ms"},
          .measure = measure_send_rate};
}

TradeStage trade_playout() {
  return {.name = "playout",
          .title = "Playout delay, which removes jitter from the goal",
          .cost = "additional delay",
          .cost_unit = "ms",
          .error = "rms acceleration of the tool",
          .error_unit = "m/s^2",
          .of_machine = false,
          .series = {"fixed", "adaptive"},
          .measure = measure_playout};
}

TradeStage trade_deadband() {
  return {.name = "deadband",
          .title = "Dead band of the reported stiffness, 0.5 to 30 %",
          .cost = "data rate of the stiffness reports",
          .cost_unit = "bit/s",
          .error = "error of the displayed stiffness",
          .error_unit = "%",
          .of_machine = false,
          .series = {"deadband"},
          .measure = measure_deadband};
}

}  // namespace longreach
