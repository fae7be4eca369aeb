#pragma once
// One schedule, run from beginning to end under the eyes of the oracle.

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
  std::vector<std::uint64_t> injected;  // by kind
  std::vector<Judged> judged;           // by invariant
  std::map<std::string, std::uint64_t> guards;
  std::vector<Breach> violations;  // the first of each invariant
  double virtual_s = 0.0, engaged_s = 0.0;
  std::uint64_t trajectory = 0;  // hash of all setpoints and wrenches
};

/// The schedule of a seed, with its scenario.
Schedule schedule_of(std::uint64_t seed);

Trial run_trial(const Schedule& schedule, InjectedDefect injected_defect = InjectedDefect::kNone);
Trial run_trial(const Scenario& scenario, const Schedule& schedule, const Clocks& clocks);

/// When a schedule fails, if it does.
using Fails = std::function<std::optional<double>(const Schedule&)>;

/// The fewest and shortest faults of a schedule that still fails.
Schedule shrink(const Schedule& schedule, const Fails& fails);
/// ... that still violates `invariant`.
Schedule shrink(const Schedule& schedule, std::string_view invariant);

}  // namespace longreach
