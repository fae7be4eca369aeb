#pragma once
// Tests of extreme values. A row is a quantity, a cell is one value of it, passed to the stage that uses it.
// Each cell expects one of two outcomes: stable and accurate within a bound, or refused with a message that
// contains certain words. Everything else is bad: the other outcome, divergence, NaN, generated energy, an
// error above the bound of the row, an implausible value that is accepted without a message. Each row has a
// control, the same measurement of a wrong implementation, which must come out bad.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

enum class ExtremeOutcome : std::uint8_t { kStable, kRefused, kBad };

struct ExtremeResult {
  ExtremeOutcome outcome = ExtremeOutcome::kBad;
  double accuracy = 0.0;  // measured value; kStable only
  std::string words;      // kRefused: the message; kBad: the reason
};

/// Stable if 0 <= error <= bound and both are finite; else bad.
ExtremeResult accurate(double error, double bound);
ExtremeResult refused(std::string message);
ExtremeResult bad(std::string what);

struct ExtremeCell {
  std::string value;    // with its unit
  std::string refusal;  // text that the message of the refusal must contain; empty: expected to be stable
  std::function<ExtremeResult(std::uint64_t seed)> run;
};

struct ExtremeRow {
  std::string quantity;
  std::string measure;  // meaning of `accuracy`
  ExtremeCell control;
  std::vector<ExtremeCell> cells;
};

/// Shortest text of a value: 1e5, 0.001, 2e-05.
std::string short_text(double value);

/// Runs a cell and compares the outcome with the expected one. A ConfigError counts as refused, any other
/// exception as bad.
ExtremeResult judge(const ExtremeCell& cell, std::uint64_t seed);

/// All rows, grouped by stage.
const std::vector<ExtremeRow>& extreme_rows();

/// Runs all of them; returns metrics, and writes the table to `run.out`.
std::vector<Metric> run_extremes(const ExperimentRun& run);
std::vector<Plot> extremes_plots();

// The rows of each stage.
std::vector<ExtremeRow> extreme_impacts();      // slave/scene
std::vector<ExtremeRow> extreme_estimates();    // slave/estimation
std::vector<ExtremeRow> extreme_renderings();   // master
std::vector<ExtremeRow> extreme_kinematics();   // slave/robot, master/devices, common/spatial
std::vector<ExtremeRow> extreme_mappings();     // master/mapping
std::vector<ExtremeRow> extreme_links();        // common/link, common/wire
std::vector<ExtremeRow> extreme_settings();     // common/config
std::vector<ExtremeRow> extreme_whole_loops();  // the laboratory

}  // namespace longreach
