// Every quantity at its extremes: stable and how accurate, or refused with which message (extremes.hpp).

#include "tests/extremes/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/config/config.hpp"
#include "common/core/geometry_error.hpp"
#include "common/text/number_text.hpp"
#include "tests/extremes/extremes_table.hpp"

namespace longreach {

ExtremeResult accurate(double error, double bound) {
  if (error >= 0.0 && error <= bound && std::isfinite(bound)) return {ExtremeOutcome::kStable, error, ""};
  return bad(format_number(error) + " is not within " + format_number(bound));
}
ExtremeResult refused(std::string message) { return {ExtremeOutcome::kRefused, 0.0, std::move(message)}; }
ExtremeResult bad(std::string what) { return {ExtremeOutcome::kBad, 0.0, std::move(what)}; }

std::string short_text(double value) {
  if (std::abs(value) < std::numeric_limits<double>::min()) return format_number(value);
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  std::string short_one(text);
  if (const auto plus = short_one.find("e+"); plus != std::string::npos) short_one.erase(plus + 1, 1);
  if (const auto zero = short_one.find("e0"); zero != std::string::npos) short_one.erase(zero + 1, 1);
  return short_one;
}

namespace {

ExtremeResult run_cell(const ExtremeCell& cell, std::uint64_t seed) {
  try {
    return cell.run(seed);
  } catch (const ConfigError& e) {
    return refused(e.what());
  } catch (const GeometryError& e) {
    return refused(e.what());
  } catch (const std::exception& e) {
    return bad(e.what());
  }
}

}  // namespace

ExtremeResult judge(const ExtremeCell& cell, std::uint64_t seed) {
  const ExtremeResult result = run_cell(cell, seed);
  if (result.outcome == ExtremeOutcome::kStable && !cell.refusal.empty())
    return bad("taken, though it should be refused: " + cell.refusal);
  if (result.outcome == ExtremeOutcome::kRefused && cell.refusal.empty())
    return bad("refused, though it should be stable: " + result.words);
  if (result.outcome == ExtremeOutcome::kRefused && result.words.find(cell.refusal) == std::string::npos)
    return bad("refused, but not because of " + cell.refusal + ": " + result.words);
  return result;
}

const std::vector<ExtremeRow>& extreme_rows() {
  static const std::vector<ExtremeRow> rows = [] {
    std::vector<ExtremeRow> all;
    for (const auto& stage : {extreme_impacts, extreme_estimates, extreme_renderings, extreme_kinematics,
                              extreme_mappings, extreme_links, extreme_settings, extreme_whole_loops}) {
      for (ExtremeRow& row : stage()) all.push_back(std::move(row));
    }
    return all;
  }();
  return rows;
}

// The experiment draws its table itself.
std::vector<Plot> extremes_plots() {
  Plot plot;
  plot.name = "extremes";
  plot.title = "Every quantity at its extremes";
  return {plot};
}

std::vector<Metric> run_extremes(const ExperimentRun& run) {
  const std::vector<ExtremeRow>& rows = extreme_rows();
  std::vector<std::vector<ExtremeResult>> results;
  double controls_bad = 0.0;
  for (const ExtremeRow& row : rows) {
    results.emplace_back();
    controls_bad += judge(row.control, run.seed).outcome == ExtremeOutcome::kBad ? 1.0 : 0.0;
    for (const ExtremeCell& cell : row.cells) results.back().push_back(judge(cell, run.seed));
    if (run.progress) run.progress(static_cast<double>(results.size()) / static_cast<double>(rows.size()));
  }
  if (!run.out.empty()) write_extremes(run.out, rows, results);
  const auto count = [&results](ExtremeOutcome outcome) {
    double sum = 0.0;
    for (const auto& row : results)
      sum += static_cast<double>(std::ranges::count(row, outcome, &ExtremeResult::outcome));
    return sum;
  };
  const double stable = count(ExtremeOutcome::kStable), turned_away = count(ExtremeOutcome::kRefused);
  const double wrong = count(ExtremeOutcome::kBad);
  return {{"cells", stable + turned_away + wrong, ""},
          {"quantities", static_cast<double>(rows.size()), ""},
          {"stable", stable, ""},
          {"refused", turned_away, ""},
          {"bad", wrong, ""},
          {"controls", static_cast<double>(rows.size()), ""},
          {"controls_bad", controls_bad, ""}};
}

}  // namespace longreach
