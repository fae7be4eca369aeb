#pragma once
// The grid of the delay sweep (every law x round trip x wall x hand) and its results.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/delay/wall_press.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"
#include "schema/config_master.hpp"

namespace longreach {

struct LawName {
  RenderingLaw law;
  std::string_view column;  // column name in the traces
  std::string_view title;   // title used in the plots
};
inline constexpr std::array<LawName, 6> kLawNames = {
    {{RenderingLaw::kDirect, "direct", "direct force"},
     {RenderingLaw::kPositionPosition, "position_position", "position-position"},
     {RenderingLaw::kWave, "wave", "wave variables"},
     {RenderingLaw::kTdpa, "tdpa", "passivity control"},
     {RenderingLaw::kTank, "tank", "energy tank"},
     {RenderingLaw::kStiffness, "stiffness", "estimated stiffness"}}};

struct DelayGrid {
  std::vector<double> rtt_s = {0.0, 0.03, 0.3, 0.85, 2.6, 3.0, 7.0};
  std::vector<double> wall_n_per_m = {200.0, 500.0, 1000.0, 5000.0};
  std::vector<Grip> grips = {Grip::kLight, Grip::kFirm, Grip::kReleased};

  [[nodiscard]] bool has_rtt(double s) const;
};

struct DelayResult {
  RenderingLaw law = RenderingLaw::kStiffness;
  double rtt_s = 0.0;
  double wall_n_per_m = 0.0;
  Grip grip = Grip::kLight;
  Pressed found{};
  double error = 0.0;        // relative error of the displayed stiffness; 0 for a released handle
  double estimate_sd = 0.0;  // relative; only for the stiffness law
};

struct LawSummary {
  int cases = 0;
  int limit_cycles = 0;
  int right = 0;  // number of stable runs with a displayed stiffness within 5 %
  double error_max = 0.0;
  double port_energy_min_j = 0.0;
  double drawdown_max_j = 0.0;

  void add(const DelayResult& r);
};

class DelayResults {
 public:
  void add(const DelayResult& r) { results_.push_back(r); }
  [[nodiscard]] std::size_t size() const { return results_.size(); }

  /// Throws std::out_of_range if the case was not run.
  [[nodiscard]] const Pressed& at(RenderingLaw law, double rtt_s, double wall_n_per_m, Grip grip) const;
  /// Maximum displayed stiffness among the walls without a limit cycle, capped at the stiffness of each wall;
  /// 0 if every wall has a limit cycle.
  [[nodiscard]] double displayable_n_per_m(RenderingLaw law, double rtt_s, Grip grip) const;
  [[nodiscard]] LawSummary summary(RenderingLaw law) const;

  /// Writes all results to sweep.csv, and for each wall the results of the light hand as functions of the
  /// delay to WALL_n_per_m.csv.
  void write(const std::filesystem::path& folder) const;

 private:
  std::vector<DelayResult> results_;
};

/// Coupling stiffness of the position-position law for this delay: 80 % of its stability limit, at most 2
/// N/mm.
double tuned_coupling_n_per_m(const DeviceConfig& device, const ComparisonConfig& config, double rtt_s);

DelayResults sweep_delays(const ExperimentRun& run, const DelayGrid& grid, const DeviceConfig& device);

/// Returns the configured link with half of this round trip in each direction.
proto::LinkProfile plain_link(const proto::LabConfig& config, double rtt_s);

/// Runs the stiffness law in the laboratory and measures the displayed stiffness as the experiment `touch`
/// does. With Grip::kReleased, the hand releases the handle inside the wall.
DelayResult touch_across(const ExperimentRun& run, const proto::LinkProfile& link, double wall_n_per_m,
                         Grip grip);

/// Results of the experiment `delay-seeds`, or of one slice of it: one link and one wall, with every hand and
/// seed.
struct DelaySeeds {
  std::string link;  // link of the slice, for example "moon" or "3 s"
  double wall_n_per_m = 0.0;
  LawSummary held, released;
  double estimate_sd_max = 0.0;
};
std::size_t delay_seeds_slices(const ExperimentRun& run);
DelaySeeds delay_seeds_slice(const ExperimentRun& run, std::size_t slice);

/// Formats a number for use in names, for example "0.3".
std::string short_number(double x);

}  // namespace longreach
