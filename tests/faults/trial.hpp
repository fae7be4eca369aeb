#pragma once
// Runs one schedule from start to end under the oracle.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/faults/injected_defect.hpp"
#include "tests/faults/invariant.hpp"
#include "tests/faults/schedule.hpp"

namespace longreach {

struct Judged {
  std::string_view name, says;
  std::uint64_t times = 0, violated = 0;
};

struct Trial {
  std::vector<std::uint64_t> injected;  // number of injections of each kind
  std::vector<Judged> judged;           // numbers of checks and violations of each invariant
  std::map<std::string, std::uint64_t> guards;
  std::vector<Breach> violations;  // first violation of each invariant
  double virtual_s = 0.0, engaged_s = 0.0;
  std::uint64_t trajectory = 0;  // hash of all setpoints and wrenches
};

/// Returns the schedule of a seed for the scenario of that seed.
Schedule schedule_of(std::uint64_t seed);

Trial run_trial(const Schedule& schedule, InjectedDefect injected_defect = InjectedDefect::kNone);
Trial run_trial(const Scenario& scenario, const Schedule& schedule, const Clocks& clocks);

/// Returns the time at which a schedule fails, or std::nullopt if it does not fail.
using Fails = std::function<std::optional<double>(const Schedule&)>;

/// Returns a minimal schedule that still fails, with the fewest and shortest faults.
Schedule shrink(const Schedule& schedule, const Fails& fails);
/// Like the function above, but only a violation of `invariant` counts as a failure.
Schedule shrink(const Schedule& schedule, std::string_view invariant);

}  // namespace longreach
