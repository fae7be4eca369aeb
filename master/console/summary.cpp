#include "master/console/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "master/console/formatted.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

/// Converts to mJ. Values below half a microjoule are rounding errors and become zero, without a sign.
double in_mj(double j) { return std::fabs(j) < 5e-7 ? 0.0 : j * 1e3; }

constexpr std::size_t kRttSamples = 36000;
constexpr double kRttPeriodS = 0.1;
constexpr double kSpringForceMinN = 0.2;
constexpr double kSettleS = 1.0;  // after the first touch, in addition to one RTT
constexpr std::uint64_t kSamplesMin = 50;

std::string count_text(std::uint64_t count, const char* what) {
  return formatted("%llu ", static_cast<unsigned long long>(count)) + what;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

RunCounters counters_of(const ConsoleSnapshot& last) {
  RunCounters counters;
  counters.late_ticks = last.late_ticks;
  counters.missed_ticks = last.missed_ticks;
  counters.rejected_values =
      last.view.rejected_values + last.rejected[static_cast<std::size_t>(Rejection::kValue)];
  counters.rejected_datagrams = std::accumulate(last.rejected.begin(), last.rejected.end(), std::uint64_t{0});
  if (!last.view.far_known) return counters;
  counters.late_ticks += last.view.far.late_ticks;
  counters.rejected_datagrams += last.view.far.rejected;
  counters.limit_violations = last.view.far.limit_violations;
  return counters;
}

}  // namespace

RunSummary::RunSummary(const SummaryConfig& config)
    : config_(config), rtt_s_(kRttSamples), holds_(config.outages) {}

void RunSummary::add(double seconds, const MasterView& view, std::optional<double> rtt_s) {
  const double dt_s = std::max(seconds - last_s_, 0.0);
  last_s_ = std::max(seconds, last_s_);
  if (rtt_s && seconds >= next_rtt_s_) {
    rtt_s_.push(*rtt_s);
    next_rtt_s_ = seconds + kRttPeriodS;
  }
  if (view.state == SafetyState::kEngaged) engaged_s_ += dt_s;
  energy_min_j_ = std::fmin(energy_min_j_, view.port_energy_min_j);
  energy_drawdown_j_ = std::fmax(energy_drawdown_j_, view.energy_drawdown_j);
  holds_.add(seconds, view);
  add_force_step(view);
  add_contact(seconds, view, rtt_s);
}

void RunSummary::add_force_step(const MasterView& view) {
  // The view repeats the last step until the next report. Only a new step counts, relative to the force at
  // that time.
  if (view.reports == reports_) return;
  reports_ = view.reports;
  /// Negative if the force vanishes with its surface, which is not a fault.
  const double step_n = view.force_step_n;
  const double allowed_n =
      std::fmax(config_.force_step_n, config_.force_step_share * view.spring_force_n.norm());
  force_step_max_n_ = std::fmax(force_step_max_n_, step_n);
  force_step_excess_n_ = std::fmax(force_step_excess_n_, step_n - allowed_n);
}

void RunSummary::add_contact(double seconds, const MasterView& view, std::optional<double> rtt_s) {
  if (view.in_contact && !touched_at_s_) touched_at_s_ = seconds;
  if (touched_at_s_ && (view.state != SafetyState::kEngaged || view.clutched)) {
    // The handle resumes from another position, so that the position of the wall changes for it and settles
    // again.
    touched_at_s_ = seconds;
    fit_.begin_group();
  }
  if (view.stiffness_clamped) cut_to_n_per_m_ = view.stiffness_max_n_per_m;
  const bool settled = touched_at_s_ && rtt_s && seconds >= *touched_at_s_ + *rtt_s + kSettleS;
  const bool clamped = view.force_clamped || view.stiffness_clamped;
  if (!settled || clamped || view.mode != MotionMode::kPosition) return;
  const double force_n = -view.inward.dot(view.spring_force_n);
  if (!(force_n > kSpringForceMinN)) return;
  fit_.add(view.inward.dot(view.p_MH), force_n);
  if (!view.far_known || !view.far.estimate.valid) return;
  estimate_sum_n_per_m_ += view.far.estimate.stiffness_n_per_m;
  ++estimates_;
}

Summary RunSummary::finish(const ConsoleSnapshot& last, const std::vector<HandTrouble>& hand) const {
  Summary summary;
  if (!rtt_s_.empty()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < rtt_s_.size(); ++i) values.push_back(rtt_s_[i]);
    summary.rtt_s = median(std::move(values));
  }
  summary.engaged_s = engaged_s_;
  summary.touched = touched_at_s_.has_value();
  summary.stiffness_samples = fit_.count();
  if (fit_.valid() && fit_.count() >= kSamplesMin) summary.displayed_stiffness_n_per_m = fit_.slope();
  if (estimates_ > 0) {
    summary.expected_stiffness_n_per_m = config_.ke * estimate_sum_n_per_m_ / static_cast<double>(estimates_);
  }
  summary.port_energy_min_j = std::fmin(energy_min_j_, last.view.port_energy_min_j);
  summary.energy_drawdown_j = std::fmax(energy_drawdown_j_, last.view.energy_drawdown_j);
  summary.force_step_max_n = force_step_max_n_;
  summary.force_step_excess_n = force_step_excess_n_;
  summary.counters = counters_of(last);
  if (last.view.refusal != HoldCause::kNone) {
    const bool of_the_hand = last.view.refusal == HoldCause::kDeviceFault && !hand.empty();
    summary.refusal = of_the_hand ? hand.back().text : refusal_in_words(last.view);
  }
  add_checks(summary, hand);
  return summary;
}

std::string RunSummary::engaged_in_words(const Summary& s) const {
  std::string text = formatted("engaged for %.1f of %.1f s (%.0f %%)", s.engaged_s, last_s_,
                               last_s_ > 0.0 ? 100.0 * s.engaged_s / last_s_ : 0.0);
  if (s.engaged_s > 0.0) return text;
  if (s.refusal.empty()) return text + ": no engagement was requested, or no datagram arrived from the slave";
  return text + ": " + s.refusal;
}

void RunSummary::add_checks(Summary& s, const std::vector<HandTrouble>& hand) const {
  std::vector<SummaryCheck>& checks = s.checks;
  checks.push_back({s.rtt_s ? formatted("round trip %.3f s (median)", *s.rtt_s) : "round trip: not measured",
                    s.rtt_s.has_value()});
  checks.push_back({engaged_in_words(s), s.engaged_s > 0.0});
  const bool both = s.displayed_stiffness_n_per_m && s.expected_stiffness_n_per_m;
  if (cut_to_n_per_m_ > 0.0) {
    std::string line = "the wall is stiffer than this device can render: ";
    if (config_.wall_n_per_m) line += formatted("%.3f N/mm was ", 1e-3 * config_.ke * *config_.wall_n_per_m);
    checks.push_back({line + formatted("limited to %.3f N/mm", 1e-3 * cut_to_n_per_m_), true, true});
  } else if (both) {
    const double shown = *s.displayed_stiffness_n_per_m;
    const double estimated = *s.expected_stiffness_n_per_m;
    const double expected = config_.wall_n_per_m ? config_.ke * *config_.wall_n_per_m : estimated;
    const double error = shown / expected - 1.0;
    std::string line = formatted("displayed stiffness %.3f N/mm, ", shown * 1e-3);
    if (config_.wall_n_per_m) line += formatted("the wall %.3f N/mm, ", expected * 1e-3);
    line += formatted("estimated %.3f N/mm (%+.1f %%)", estimated * 1e-3, error * 100.0);
    checks.push_back({line, std::fabs(error) <= config_.stiffness_error_max});
  } else if (config_.contact_expected) {
    checks.push_back(
        {s.touched ? "displayed stiffness: the contact was too short to measure it" : "no contact", false});
  }
  checks.push_back({formatted("minimum port energy %.3f mJ; %.3f mJ was returned to the operator",
                              in_mj(s.port_energy_min_j), in_mj(s.energy_drawdown_j)),
                    s.port_energy_min_j >= -(config_.store_j + config_.energy_out_max_j) &&
                        s.energy_drawdown_j <= config_.energy_out_max_j});
  checks.push_back({formatted("largest force step caused by a report %.3f N", s.force_step_max_n),
                    s.force_step_excess_n <= 0.0});
  const RunCounters& n = s.counters;
  std::string late = count_text(n.late_ticks, "ticks late by over 100 ms");
  if (n.late_ticks > 0) late += ": this machine is busy";
  checks.push_back({late, true, n.late_ticks > 0});
  add_holds(s, hand);
  checks.push_back({count_text(n.rejected_values, "rejected values"), n.rejected_values == 0});
  std::string limits = count_text(n.limit_violations, "limit violations");
  if (n.limit_violations > 0) limits += ": the slave's log and longreach status list them";
  checks.push_back({limits, n.limit_violations == 0});
}

void RunSummary::add_holds(Summary& s, const std::vector<HandTrouble>& hand) const {
  const std::uint64_t faults = holds_.count(HoldAttribution::kSystem), all = holds_.count();
  std::string text = count_text(all, "holds");
  if (faults > 0)
    text += formatted(", %llu of them caused by a fault", static_cast<unsigned long long>(faults));
  s.checks.push_back({text, faults == 0});
  for (HoldLog::Sentence& hold : holds_.words(hand))
    s.checks.push_back({std::move(hold.text), !hold.fault, true});
}

bool Summary::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const SummaryCheck& check) { return check.ok; });
}

std::string Summary::text() const {
  std::string page;
  for (const SummaryCheck& check : checks)
    page += std::string(check.ok ? check.warns ? "  warn  " : "  ok    " : "  FAIL  ") + check.text + "\n";
  page += "        " + count_text(counters.missed_ticks, "ticks missed, ") +
          count_text(counters.rejected_datagrams, "datagrams rejected\n");
  return page + (passed() ? "verdict: all checks hold\n" : "verdict: at least one check FAILED\n");
}

}  // namespace longreach
