#pragma once
// The main experiment, step by step: the simulated operator touches the scene's wall over the link.
// `run_touch` (experiment.hpp) runs all steps; the Python module runs them one by one.

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

class Laboratory;

class TouchRun {
 public:
  /// The configuration must be complete. Throws std::invalid_argument for a comparison law, like Laboratory.
  TouchRun(const proto::LabConfig& config, std::uint64_t seed);
  ~TouchRun();

  /// Runs one tick of both sides.
  void step();
  /// True once the script has completed its cycles or duration_s has passed.
  [[nodiscard]] bool done() const;
  /// Completed fraction of the maximum duration.
  [[nodiscard]] double completed() const;
  [[nodiscard]] std::vector<Metric> metrics() const;

  /// Names of the columns of the trace.
  static const std::vector<std::string_view>& columns();
  /// True if this tick has a row in the trace, which has trace_hz rows per second.
  [[nodiscard]] bool row_is_due() const;
  /// Values of the columns in this tick; NaN for a missing value.
  [[nodiscard]] std::vector<double> row() const;

  [[nodiscard]] Laboratory& laboratory();
  [[nodiscard]] const Laboratory& laboratory() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Runs the experiment and records both sides in OUT/touch.mcap. The recording does not affect the run.
/// Throws RecordingError.
std::vector<Metric> run_touch_recorded(const ExperimentRun& run);

}  // namespace longreach
