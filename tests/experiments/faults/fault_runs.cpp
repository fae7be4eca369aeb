#include <cstdio>

#include "tests/experiments/faults/faults.hpp"
#include "tests/experiments/faults/scenario.hpp"
#include "tests/experiments/faults/twin.hpp"
#include "tests/experiments/on_all_cores.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kTwins = 20;  // one seed in so many has one

}  // namespace

Tally run_faults(std::uint64_t first, std::uint64_t count, const std::function<void(double)>& progress) {
  std::vector<Trial> trials(count);
  std::vector<std::optional<bool>> twins(count);
  const auto one = [&](std::size_t i) {
    trials[i] = run_trial(schedule_of(first + i));
    if ((first + i) % kTwins == 0) twins[i] = refused_changes_nothing(first + i);
  };
  on_all_cores(count, one, progress);
  Tally tally;
  for (std::uint64_t i = 0; i < count; ++i) {
    tally.add(first + i, trials[i]);
    if (twins[i]) tally.judge_twin(first + i, *twins[i]);
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
            "\nThe faults that matter; `longreach-lab run faults --schedule FILE` repeats them:\n" +
            to_text(shrink(schedule, v.invariant));
  }
  if (trial.violations.empty()) said += "\nnothing is violated\n";
  return trial.violations.empty();
}

}  // namespace longreach
