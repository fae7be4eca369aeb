#include "master/console/summary.hpp"

#include <algorithm>
#include <array>
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

std::string count_text(std::uint64_t count, const std::string& noun, const char* more = "") {
  return formatted("%llu ", static_cast<unsigned long long>(count)) + noun + (count == 1 ? "" : "s") + more;
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
    : config_(config),
      rtt_s_(kRttSamples),
      stretches_(config.ke, config.wall_n_per_m),
      holds_(config.outages) {}

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
  stretches_.add(seconds, view, rtt_s);
}

void RunSummary::add_force_step(const MasterView& view) {
  const RenderedSurface before = before_;
  before_ = {view.surface_known, view.inward, view.stiffness_n_per_m, view.surface_m};
  // The view repeats the last step until the next report. Only a new step counts, relative to the force at
  // that time.
  if (view.reports == reports_) return;
  reports_ = view.reports;
  /// Negative if the force vanishes with its surface, which is not a fault.
  const double step_n = view.force_step_n;
  const double allowed_n =
      std::fmax(config_.force_step_n, config_.force_step_share * view.spring_force_n.norm());
  if (step_n > force_step_max_n_) {
    force_step_max_n_ = step_n;
    step_from_ = before;
    step_to_ = before_;
  }
  force_step_excess_n_ = std::fmax(force_step_excess_n_, step_n - allowed_n);
}

Summary RunSummary::finish(const ConsoleSnapshot& last, const std::vector<HandTrouble>& hand) const {
  Summary summary;
  if (!rtt_s_.empty()) {
    std::vector<double> values;
    for (std::size_t i = 0; i < rtt_s_.size(); ++i) values.push_back(rtt_s_[i]);
    summary.rtt_s = median(std::move(values));
  }
  summary.engaged_s = engaged_s_;
  summary.stiffness = stretches_.result();
  summary.port_energy_min_j = std::fmin(energy_min_j_, last.view.port_energy_min_j);
  summary.energy_drawdown_j = std::fmax(energy_drawdown_j_, last.view.energy_drawdown_j);
  summary.force_step_max_n = force_step_max_n_;
  summary.force_step_excess_n = force_step_excess_n_;
  summary.counters = counters_of(last);
  if (last.view.refusal != HoldCause::kNone) {
    const bool of_the_hand = last.view.refusal == HoldCause::kDeviceFault && !hand.empty();
    summary.refusal = of_the_hand ? hand.back().text : refusal_in_words(last.view);
  }
  add_checks(summary, last, hand);
  return summary;
}

std::string RunSummary::engaged_in_words(const Summary& s) const {
  std::string text = formatted("engaged for %.1f of %.1f s (%.0f %%)", s.engaged_s, last_s_,
                               last_s_ > 0.0 ? 100.0 * s.engaged_s / last_s_ : 0.0);
  if (s.engaged_s > 0.0) return text;
  if (s.refusal.empty()) return text + ": no engagement was requested, or no datagram arrived from the slave";
  return text + ": " + s.refusal;
}

std::string RunSummary::step_in_words() const {
  std::string text = formatted("largest force step caused by a report %.3f N", force_step_max_n_);
  if (!(force_step_max_n_ > 0.0)) return text;
  const RenderedSurface &from = step_from_, &to = step_to_;
  const double stiffer = to.stiffness_n_per_m - from.stiffness_n_per_m;
  if (!from.known) return text + ": a new surface";
  if (to.inward.dot(from.inward) < 1.0 - 1e-6) return text + ": the direction of the surface";
  if (std::fabs(stiffer) > 0.01 * from.stiffness_n_per_m)
    return text + formatted(": the stiffness changed from %.2f to %.2f N/mm", 1e-3 * from.stiffness_n_per_m,
                            1e-3 * to.stiffness_n_per_m);
  return text +
         formatted(": the position of the surface changed by %.3f mm", 1e3 * (to.surface_m - from.surface_m));
}

void RunSummary::add_checks(Summary& s, const ConsoleSnapshot& last,
                            const std::vector<HandTrouble>& hand) const {
  using enum RunVerdict;
  std::vector<SummaryCheck>& checks = s.checks;
  checks.push_back({s.rtt_s ? formatted("round trip %.3f s (median)", *s.rtt_s) : "round trip: not measured",
                    s.rtt_s ? kWell : kFault});
  const bool observed = s.rtt_s && s.refusal.empty() && !config_.contact_expected;
  checks.push_back({engaged_in_words(s), s.engaged_s > 0.0 ? kWell : observed ? kEvents : kFault});
  add_stiffness(s);
  checks.push_back({formatted("minimum port energy %.3f mJ; %.3f mJ was returned to the operator",
                              in_mj(s.port_energy_min_j), in_mj(s.energy_drawdown_j)),
                    s.port_energy_min_j >= -(config_.store_j + config_.energy_out_max_j) &&
                            s.energy_drawdown_j <= config_.energy_out_max_j
                        ? kWell
                        : kFault});
  checks.push_back({step_in_words(), s.force_step_excess_n <= 0.0 ? kWell : kFault});
  const RunCounters& n = s.counters;
  std::string late = count_text(n.late_ticks, "tick", " late by over 100 ms");
  if (n.late_ticks > 0) late += ": this machine is busy";
  checks.push_back({late, n.late_ticks > 0 ? kEvents : kWell});
  add_holds(s, hand);
  checks.push_back(
      {count_text(n.rejected_values, "rejected value"), n.rejected_values == 0 ? kWell : kFault});
  std::string limits = count_text(n.limit_violations, "limit violation");
  if (n.limit_violations > 0) limits += ": the slave's log and longreach status list them";
  checks.push_back({limits, n.limit_violations == 0 ? kWell : kFault});
  add_end(s, last);
}

void RunSummary::add_stiffness(Summary& s) const {
  using enum RunVerdict;
  const StiffnessStretches::Result& felt = s.stiffness;
  if (felt.cut_to_n_per_m > 0.0) {
    std::string line = "a surface is stiffer than this device can render: ";
    if (config_.wall_n_per_m) line += formatted("%.3f N/mm was ", 1e-3 * config_.ke * *config_.wall_n_per_m);
    s.checks.push_back({line + formatted("limited to %.3f N/mm", 1e-3 * felt.cut_to_n_per_m), kEvents});
  }
  if (felt.judged > 0) {
    std::string line = formatted("displayed stiffness %.3f N/mm, ", 1e-3 * felt.worst.displayed_n_per_m);
    if (config_.wall_n_per_m)
      line += formatted("the wall %.3f N/mm, ", 1e-3 * config_.ke * *config_.wall_n_per_m);
    line += formatted("estimated %.3f N/mm (%+.1f %%)", 1e-3 * felt.worst.estimated_n_per_m,
                      100.0 * felt.worst.error);
    if (felt.judged > 1)
      line += formatted(", the worst of %llu stretches", static_cast<unsigned long long>(felt.judged));
    s.checks.push_back({line, std::fabs(felt.worst.error) <= config_.stiffness_error_max ? kWell : kFault});
  } else if (felt.touched && felt.cut_to_n_per_m == 0.0) {
    s.checks.push_back({"displayed stiffness: not judged, because no contact was pressed long enough",
                        config_.contact_expected ? kFault : kWell});
  } else if (config_.contact_expected && !felt.touched) {
    s.checks.push_back({"no contact", kFault});
  }
}

void RunSummary::add_holds(Summary& s, const std::vector<HandTrouble>& hand) const {
  using enum RunVerdict;
  s.checks.push_back({count_text(holds_.count(), "hold"), kWell});
  for (HoldLog::Sentence& hold : holds_.words(hand)) {
    const bool asked = hold.attribution == HoldAttribution::kOperator;
    const bool fault = hold.attribution == HoldAttribution::kFault && hold.lasts;
    s.checks.push_back({std::move(hold.text), fault ? kFault : asked ? kWell : kEvents});
  }
}

/// Adds a fault that lasts until the end although no hold tells of it.
void RunSummary::add_end(Summary& s, const ConsoleSnapshot& last) const {
  if (s.verdict() == RunVerdict::kFault) return;
  const MasterView& view = last.view;
  const bool fault = view.state == SafetyState::kFault || view.far_state == SafetyState::kFault;
  if (fault || (view.silent && !config_.outages))
    s.checks.push_back({"at the end: " + last.shown.sentence, RunVerdict::kFault});
}

std::string_view to_string(RunVerdict verdict) {
  switch (verdict) {
    case RunVerdict::kWell:
      return "ended well";
    case RunVerdict::kEvents:
      return "ended with events";
    case RunVerdict::kFault:
      break;
  }
  return "ended in a fault";
}

RunVerdict Summary::verdict() const {
  RunVerdict worst = RunVerdict::kWell;
  for (const SummaryCheck& check : checks) worst = std::max(worst, check.verdict);
  return worst;
}

std::string Summary::text() const {
  static constexpr std::array<const char*, 3> kMarks = {"  ok    ", "  event ", "  FAIL  "};
  std::string page, faults;
  for (const SummaryCheck& check : checks) {
    page += kMarks[static_cast<std::size_t>(check.verdict)] + check.text + "\n";
    if (check.verdict == RunVerdict::kFault) faults += (faults.empty() ? ": " : "; ") + check.text;
  }
  page += "        " + count_text(counters.missed_ticks, "tick", " missed, ") +
          count_text(counters.rejected_datagrams, "datagram", " rejected\n");
  return page + "verdict: " + std::string(to_string(verdict())) + faults + "\n";
}

}  // namespace longreach
