#pragma once
// Results of a run and their verdict.
//
// Displayed stiffness: least-squares slope of the contact spring's force on the handle's position, both along
// the inward normal, over the samples in position mode with a spring force over 0.2 N, nothing clamped, from
// RTT + 1 s after the first touch. It should be ke times the slave's estimate. add() allocates nothing and
// may be called once a tick or at any lower, steady rate.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/regression.hpp"
#include "common/core/ring.hpp"
#include "master/console/hold_log.hpp"
#include "master/console/snapshot.hpp"

namespace longreach {

struct SummaryConfig {
  double ke = 1.0;                       // rendered over estimated stiffness
  bool contact_expected = false;         // the script touches the wall; a person need not
  double stiffness_error_max = 0.05;     // fraction; differences below 8 to 20 % are not perceptible
  std::optional<double> wall_n_per_m{};  // true stiffness of the touched object, if known
  double store_j = 0.0;                  // initial store of the engagement
  double energy_out_max_j = 1e-3;        // energy that encoder steps can simulate without a leak
  double force_step_n = 0.1;             // a report may change the spring's force by this, or
  double force_step_share = 0.05;  // by this share of it: differences below 7 to 10 % are not perceptible
  bool outages = false;            // the profile of the link specifies outages
};

/// Counters at the end of the run.
struct RunCounters {
  std::uint64_t late_ticks = 0;  // of both sides, late by over 100 ms
  std::uint64_t missed_ticks = 0;
  std::uint64_t rejected_values = 0;     // in otherwise valid messages
  std::uint64_t rejected_datagrams = 0;  // of both sides, all reasons
  std::uint64_t limit_violations = 0;    // of the slave
};

struct SummaryCheck {
  std::string text;
  bool ok = false;
  bool warns = false;  // a warning, but not a fault of the system
};

struct Summary {
  std::optional<double> rtt_s{};  // median over the run
  double engaged_s = 0.0;         // time in Engaged
  std::string refusal{};          // why the last engagement was not granted; empty: it was granted
  bool touched = false;
  std::optional<double> displayed_stiffness_n_per_m{};
  std::optional<double> expected_stiffness_n_per_m{};  // ke times the estimate, mean over the same samples
  std::uint64_t stiffness_samples = 0;
  double port_energy_min_j = 0.0;
  double energy_drawdown_j = 0.0;  // maximum decrease of port energy minus stored energy
  double force_step_max_n = 0.0;
  double force_step_excess_n = 0.0;  // maximum step beyond the allowed value
  RunCounters counters{};
  std::vector<SummaryCheck> checks{};

  [[nodiscard]] bool passed() const;
  /// Several lines and the verdict, each ended by '\n'.
  [[nodiscard]] std::string text() const;
};

class RunSummary {
 public:
  explicit RunSummary(const SummaryConfig& config);

  /// Records a sample of the run; `seconds` since the start must not decrease.
  void add(double seconds, const MasterView& view, std::optional<double> rtt_s);
  /// `last`: the final snapshot, for the counters. `hand`: reasons for a released handle, by time.
  [[nodiscard]] Summary finish(const ConsoleSnapshot& last, const std::vector<HandTrouble>& hand = {}) const;

 private:
  void add_contact(double seconds, const MasterView& view, std::optional<double> rtt_s);
  void add_force_step(const MasterView& view);
  void add_checks(Summary& summary, const std::vector<HandTrouble>& hand) const;
  void add_holds(Summary& summary, const std::vector<HandTrouble>& hand) const;
  [[nodiscard]] std::string engaged_in_words(const Summary& summary) const;

  SummaryConfig config_;
  Ring<double> rtt_s_;  // ten per second, the last hour
  double next_rtt_s_ = 0.0;
  double last_s_ = 0.0;
  double engaged_s_ = 0.0;
  std::optional<double> touched_at_s_{};
  LineFit fit_;
  double estimate_sum_n_per_m_ = 0.0;
  std::uint64_t estimates_ = 0;
  double cut_to_n_per_m_ = 0.0;  // limit of the device, if that was below the wall; 0: it was not
  double energy_min_j_ = 0.0;
  double energy_drawdown_j_ = 0.0;
  std::uint64_t reports_ = 0;
  double force_step_max_n_ = 0.0;
  double force_step_excess_n_ = 0.0;
  HoldLog holds_;
};

}  // namespace longreach
