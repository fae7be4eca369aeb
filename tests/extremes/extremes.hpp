#pragma once
// Quantities at their extremes, each through the stage that takes it: a row is a quantity, a cell one value
// of it. A cell says which of two it shall be: stable and accurate to a number, or refused with a message
// that has a certain key word. Anything else is bad: the other one, a number that is not one, divergence,
// generated energy, an error above the row's bound, silence about a value that cannot be meant. Each row
// has a control, the same measurement of something that is wrong: it has to come out bad.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/experiment.hpp"

namespace longreach {

enum class ExtremeOutcome : std::uint8_t { kStable, kRefused, kBad };

struct ExtremeResult {
  ExtremeOutcome outcome = ExtremeOutcome::kBad;
  double accuracy = 0.0;  // what the row measures; kStable only
  std::string words;      // kRefused: the message; kBad: what is wrong
};

/// Stable if 0 <= error <= bound, which is finite; else bad.
ExtremeResult accurate(double error, double bound);
ExtremeResult refused(std::string message);
ExtremeResult bad(std::string what);

struct ExtremeCell {
  std::string value;    // with its unit
  std::string refusal;  // expected: refused with these words in the message; empty: stable
  std::function<ExtremeResult(std::uint64_t seed)> run;
};

struct ExtremeRow {
  std::string quantity;
  std::string measure;  // what `accuracy` is
  ExtremeCell control;
  std::vector<ExtremeCell> cells;
};

/// A value as short as it can be read: 1e5, 0.001, 2e-05.
std::string short_text(double value);

/// Runs a cell and compares with what it expects. A configuration or geometry that is refused is that; any
/// other exception is bad.
ExtremeResult judge(const ExtremeCell& cell, std::uint64_t seed);

/// All rows; those of a stage stand together.
const std::vector<ExtremeRow>& extreme_rows();

/// All of them, as metrics; the table goes to `run.out`.
std::vector<Metric> run_extremes(const ExperimentRun& run);
std::vector<Plot> extremes_plots();

// Of each stage.
std::vector<ExtremeRow> extreme_impacts();      // slave/scene
std::vector<ExtremeRow> extreme_estimates();    // slave/estimation
std::vector<ExtremeRow> extreme_renderings();   // master
std::vector<ExtremeRow> extreme_kinematics();   // slave/robot, master/devices, common/spatial
std::vector<ExtremeRow> extreme_mappings();     // master/mapping
std::vector<ExtremeRow> extreme_links();        // common/link, common/wire
std::vector<ExtremeRow> extreme_settings();     // common/config
std::vector<ExtremeRow> extreme_whole_loops();  // the laboratory

}  // namespace longreach
