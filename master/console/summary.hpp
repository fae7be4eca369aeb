#pragma once
// The results of a run and the verdict on it: a run ended well, with events (a hold that did its work, a value that is
// unusual), or in a fault (a broken promise of the rendering, or a state that must be repaired). The displayed stiffness
// is judged as described in stiffness_stretches.hpp. add() does not allocate. It may be called in every tick or at any
// lower, steady rate.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/ring.hpp"
#include "master/console/hold_log.hpp"
#include "master/console/snapshot.hpp"
#include "master/console/stiffness_stretches.hpp"

namespace longreach {

struct SummaryConfig {
  double ke = 1.0;                       // ratio of rendered to estimated stiffness
  bool contact_expected = false;         // the operator is a script, which must touch the wall
  double stiffness_error_max = 0.05;     // relative; differences below 8 to 20 % are not perceptible
  std::optional<double> wall_n_per_m{};  // true stiffness of the touched object, if known
  double store_j = 0.0;                  // initial energy store of the engagement
  /// Apparent energy that encoder quantization can produce without a real leak.
  double energy_out_max_j = 1e-3;
  // A report may change the spring force by at most the larger of these two values. Relative differences
  // below 7 to 10 % are not perceptible.
  double force_step_n = 0.3;
  double force_step_share = 0.05;  // fraction of the spring force
  bool outages = false;            // the profile of the link specifies outages
};

/// Counters at the end of the run.
struct RunCounters {
  std::uint64_t late_ticks = 0;  // ticks of both sides that were more than 100 ms late
  std::uint64_t missed_ticks = 0;
  std::uint64_t rejected_values = 0;     // values rejected in otherwise valid messages
  std::uint64_t rejected_datagrams = 0;  // dropped by either side, for any reason
  std::uint64_t limit_violations = 0;    // limit violations at the slave
};

enum class RunVerdict : std::uint8_t { kWell, kEvents, kFault };
std::string_view to_string(RunVerdict verdict);

struct SummaryCheck {
  std::string text;
  RunVerdict verdict = RunVerdict::kWell;
};

struct Summary {
  std::optional<double> rtt_s{};  // median round-trip time over the run
  double engaged_s = 0.0;         // time in the state Engaged
  std::string refusal{};          // why the last requested engagement was not granted; empty if it was
  StiffnessStretches::Result stiffness{};
  double port_energy_min_j = 0.0;
  double energy_drawdown_j = 0.0;  // maximum decrease of port energy minus stored energy
  double force_step_max_n = 0.0;
  double force_step_excess_n = 0.0;  // maximum excess of a step over the allowed value
  RunCounters counters{};
  std::vector<SummaryCheck> checks{};

  /// Returns the worst of the checks.
  [[nodiscard]] RunVerdict verdict() const;
  /// Returns the results and the verdict as several lines, each terminated by '\n'.
  [[nodiscard]] std::string text() const;
};

class RunSummary {
 public:
  explicit RunSummary(const SummaryConfig& config);

  /// Adds a sample of the run. `seconds` is the time since the start; it must not decrease.
  void add(double seconds, const MasterView& view, std::optional<double> rtt_s);
  /// Returns the summary. The counters come from `last`, the final snapshot. `hand` contains the reasons why
  /// the handle counted as released, in chronological order.
  [[nodiscard]] Summary finish(const ConsoleSnapshot& last, const std::vector<HandTrouble>& hand = {}) const;

 private:
  void add_force_step(const MasterView& view);
  void add_checks(Summary& summary, const ConsoleSnapshot& last, const std::vector<HandTrouble>& hand) const;
  void add_stiffness(Summary& summary) const;
  void add_end(Summary& summary, const ConsoleSnapshot& last) const;
  void add_holds(Summary& summary, const std::vector<HandTrouble>& hand) const;
  [[nodiscard]] std::string engaged_in_words(const Summary& summary) const;
  [[nodiscard]] std::string step_in_words() const;

  SummaryConfig config_;
  Ring<double> rtt_s_;  // ten samples per second over the last hour
  double next_rtt_s_ = 0.0;
  double last_s_ = 0.0;
  double engaged_s_ = 0.0;
  StiffnessStretches stretches_;
  double energy_min_j_ = 0.0;
  double energy_drawdown_j_ = 0.0;
  std::uint64_t reports_ = 0;
  double force_step_max_n_ = 0.0;
  double force_step_excess_n_ = 0.0;
  /// What a report may change.
  struct RenderedSurface {
    bool known = false;
    Vector3 inward = Vector3::Zero();
    double stiffness_n_per_m = 0.0;
    double surface_m = 0.0;
  };
  RenderedSurface before_{};                 // in the last sample
  RenderedSurface step_from_{}, step_to_{};  // at the largest force step
  HoldLog holds_;
};

}  // namespace longreach
