// The preset `accuracy`, end to end: the computing time of both sides per millisecond, against the tracking
// error of the tool and the worst stiffness error of four walls of 500 to 4000 N/m.

#include "deploy/lab/trade/tracking.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {
namespace {

constexpr const char* kPresets[] = {"FAST", "BALANCED", "EXACT"};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

TradePoint point_of(const std::string& preset, double cost, double error) {
  TradePoint point{lower(preset), "", cost, error};
  point.standard = preset == "BALANCED";
  return point;
}

std::vector<TradePoint> measure_tracking(const ExperimentRun& run) {
  std::vector<TradePoint> points;
  for (const std::string preset : kPresets) {
    const Tracking t = track(run, {"accuracy=" + preset});
    points.push_back(point_of(preset, t.cost_us, 1e3 * t.bent_rms_m));
  }
  return points;
}

std::vector<TradePoint> measure_stiffness(const ExperimentRun& run) {
  constexpr const char* kWalls[] = {"500", "1000", "2000", "4000"};
  std::vector<TradePoint> points;
  for (const std::string preset : kPresets) {
    double error = 0.0;
    for (const std::string wall : kWalls) {
      const Touched one = touched(run, {"accuracy=" + preset, "scene.material.wall.stiffness_n_per_m=" + wall,
                                        "scene.material.wall.exponent=1.5"});
      error = std::max(error, one.stiffness_error);
    }
    points.push_back(point_of(preset, track(run, {"accuracy=" + preset}).cost_us, 100.0 * error));
  }
  return points;
}

TradeStage stage(std::string_view name, std::string_view title, std::string_view error, std::string_view unit,
                 std::vector<TradePoint> (*measure)(const ExperimentRun&)) {
  return {.name = name,
          .title = title,
          .cost = "computing time of both sides per simulated ms",
          .cost_unit = "µs",
          .error = error,
          .error_unit = unit,
          .series = {"fast", "balanced", "exact"},
          .measure = measure};
}

}  // namespace

TradeStage trade_accuracy_tracking() {
  return stage("accuracy_tracking", "Accuracy presets: tracking error of the tool",
               "rms tracking error of the tool", "mm", measure_tracking);
}

TradeStage trade_accuracy_stiffness() {
  return stage("accuracy_stiffness", "Accuracy presets: displayed stiffness of walls of 500 to 4000 N/m",
               "maximum error of the displayed stiffness", "%", measure_stiffness);
}

}  // namespace longreach
