#include <cstdio>

#include "deploy/lab/on_all_cores.hpp"
#include "tests/faults/faults.hpp"
#include "tests/faults/scenario.hpp"
#include "tests/faults/twin.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kTwins = 20;  // one seed in so many has one of each
constexpr double kFaultFree_s = 60.0;

/// What is tried besides the trial of a seed: an invariant, whether it held.
struct Besides {
  const char* invariant = nullptr;
  bool good = true;
  const char* words = "";
};

Besides besides(std::uint64_t seed) {
  switch (seed % kTwins) {
    case 0:
      if (const auto same = refused_changes_nothing(seed))
        return {"I17", *same, "a refused datagram has changed the run"};
      return {};
    case 7:
      return {"M1", clocks_change_nothing(seed), "other clocks have changed the run"};
    case 13:
      return {"L4", false_alarms(run_fault_free(seed, kFaultFree_s)) == 0, "held, though nothing was wrong"};
    default:
      return {};
  }
}

}  // namespace

Tally run_faults(std::uint64_t first, std::uint64_t count, const std::function<void(double)>& progress) {
  std::vector<Trial> trials(count);
  std::vector<Besides> others(count);
  const auto one = [&](std::size_t i) {
    trials[i] = run_trial(schedule_of(first + i));
    others[i] = besides(first + i);
  };
  on_all_cores(count, one, progress);
  Tally tally;
  for (std::uint64_t i = 0; i < count; ++i) {
    tally.add(first + i, trials[i]);
    const Besides& other = others[i];
    if (other.invariant) tally.judge(first + i, other.invariant, other.good, other.words);
  }
  return tally;
}

bool repeat_faults(const Schedule& schedule, std::string& said) {
  const Trial trial = run_trial(schedule);
  said = "# longreach-lab run touch";
  for (const std::string& setting : draw_scenario(schedule.seed).settings) said += " --set " + setting;
  said += "\n" + to_text(schedule);
  for (const Breach& v : trial.violations) {
    char when[32];
    std::snprintf(when, sizeof when, "%.3f", v.t_s);
    said += "\n" + v.invariant + " is violated at " + when + " s: " + v.words +
            "\nThe faults that matter; `faults --schedule FILE` repeats them:\n" +
            to_text(shrink(schedule, v.invariant));
  }
  const Besides other = besides(schedule.seed);
  if (!other.good) said += std::string("\n") + other.invariant + " is violated: " + other.words + "\n";
  const bool good = trial.violations.empty() && other.good;
  if (good) said += "\nnothing is violated\n";
  return good;
}

}  // namespace longreach
