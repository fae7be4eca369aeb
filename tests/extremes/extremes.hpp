#pragma once
// Tests with extreme values. Each row tests one quantity, and each cell passes one value of it to the stage
// that uses it. The expected outcome of a cell is either "stable", with an error within the bound of the row,
// or "refused", with a message that contains certain words. Everything else is bad: the other outcome,
// divergence, NaN, generated energy, an error above the bound, or an implausible value that is accepted
// without a message. Each row has a control, which is the same measurement with a wrong implementation and
// must have the outcome "bad".

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

inline constexpr double kNoticed = 0.05;     // differences of stiffness below are not felt
inline constexpr double kTouch_n = 0.3;      // sensing.touch_n: less is no contact
inline constexpr double kEnergy_j = 1e-6;    // that may come out of the device: rounding
inline constexpr double kDrawdown_j = 1e-3;  // out of the rendering, unpaid

enum class ExtremeOutcome : std::uint8_t { kStable, kRefused, kBad };

struct ExtremeResult {
  ExtremeOutcome outcome = ExtremeOutcome::kBad;
  double accuracy = 0.0;  // measured value; only for kStable
  std::string words;      // kRefused: the message; kBad: the reason
};

/// Returns "stable" if 0 <= error <= bound and both are finite, otherwise "bad".
ExtremeResult accurate(double error, double bound);
ExtremeResult refused(std::string message);
ExtremeResult bad(std::string what);

struct ExtremeCell {
  std::string value;  // with its unit
  /// Text that the refusal message must contain; empty if the cell is expected to be stable.
  std::string refusal;
  std::function<ExtremeResult(std::uint64_t seed)> run;
};

struct ExtremeRow {
  std::string quantity;
  std::string measure;  // meaning of `accuracy`
  ExtremeCell control;
  std::vector<ExtremeCell> cells;
};

/// Formats a value in its shortest form, for example 1e5, 0.001 or 2e-05.
std::string short_text(double value);

/// Runs a cell and compares the outcome with the expected one. A ConfigError counts as "refused", and any
/// other exception as "bad".
ExtremeResult judge(const ExtremeCell& cell, std::uint64_t seed);

/// Returns all rows, grouped by stage.
const std::vector<ExtremeRow>& extreme_rows();

/// Runs all rows, writes the table to `run.out` and returns the metrics.
std::vector<Metric> run_extremes(const ExperimentRun& run);
std::vector<Plot> extremes_plots();

// The rows of each stage.
std::vector<ExtremeRow> extreme_impacts();      // slave/simulation/scene
std::vector<ExtremeRow> extreme_estimates();    // slave/estimation
std::vector<ExtremeRow> extreme_renderings();   // master
std::vector<ExtremeRow> extreme_kinematics();   // slave/robot, master/devices, common/spatial
std::vector<ExtremeRow> extreme_mappings();     // master/mapping
std::vector<ExtremeRow> extreme_links();        // common/link, common/wire
std::vector<ExtremeRow> extreme_settings();     // common/config
std::vector<ExtremeRow> extreme_whole_loops();  // the laboratory

}  // namespace longreach
