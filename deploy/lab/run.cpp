#include "deploy/lab/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/config/config.hpp"
#include "common/config/number_text.hpp"
#include "deploy/lab/campaign/plan.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/progress_line.hpp"
#include "deploy/lab/settings_used.hpp"
#include "deploy/lab/touch.hpp"
#include "tests/faults/faults.hpp"

namespace longreach {
namespace {

constexpr int kDone = 0, kNoContact = 3;

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

void list_experiments() {
  for (const Experiment& e : experiments()) {
    const std::string figure = e.figure.empty() ? "" : " (" + std::string(e.figure) + ")";
    std::printf("%-16s %s%s\n", std::string(e.name).c_str(), std::string(e.summary).c_str(), figure.c_str());
  }
}

namespace {

/// One seed of the campaign of faults, or what a file says.
void repeat(const RunOptions& o) {
  Schedule schedule;
  if (o.schedule.empty()) {
    schedule = schedule_of(o.seed);
  } else {
    std::ifstream file(o.schedule);
    if (!file) throw ConfigError(o.schedule + " cannot be read");
    std::ostringstream text;
    text << file.rdbuf();
    schedule = parse_schedule(text.str());
  }
  std::string said;
  const bool holds = repeat_faults(schedule, said);
  if (!o.quiet) std::printf("%s", said.c_str());
  if (!holds) throw std::runtime_error("an invariant is violated");
}

/// A range of seeds, each judged; none is drawn or kept in a folder.
void run_seeds(const RunOptions& o) {
  const auto colon = o.seeds.find(':');
  const auto first = parse_integer<std::uint64_t>(std::string_view(o.seeds).substr(0, colon));
  const auto count = colon == std::string::npos
                         ? std::nullopt
                         : parse_integer<std::uint64_t>(std::string_view(o.seeds).substr(colon + 1));
  if (!first || !count || *count == 0 || *count > 1'000'000)
    throw ConfigError("--seeds '" + o.seeds +
                      "': write FIRST:COUNT with a COUNT from 1 to 1000000, e.g. 8000001:50");
  ProgressLine line(o.quiet);
  const Tally tally = run_faults(*first, *count, [&](double done) {
    line.show("faults: " + std::to_string(std::lround(100.0 * done)) + " %", done);
  });
  line.clear();
  say_failures(tally);
  if (!o.quiet)
    std::printf("%llu seeds from %llu, %.2f virtual hours, %.0f %% engaged: %zu failing seeds\n",
                static_cast<unsigned long long>(tally.seeds), static_cast<unsigned long long>(*first),
                tally.virtual_s / 3600.0, 100.0 * tally.engaged_s / std::max(1.0, tally.virtual_s),
                tally.failures.size());
  if (!tally.failures.empty()) throw std::runtime_error("an invariant is violated");
}

}  // namespace

int run(const RunOptions& o) {
  const bool faults = o.name == "faults";
  const Experiment* experiment = find_experiment(o.name);
  if (!experiment)
    throw ConfigError("there is no experiment '" + o.name + "'; `longreach-lab list` shows them");
  const proto::LabConfig config = configure(o.settings, find_deploy_folder());
  refuse_unused(*experiment, o.settings);
  if (!o.seeds.empty() && !faults) throw ConfigError("--seeds is for the experiment faults alone");
  if (!o.seeds.empty()) return run_seeds(o), kDone;
  if (!o.schedule.empty() && !faults) throw ConfigError("--schedule is for the experiment faults alone");
  if (faults && (o.seeded || !o.schedule.empty())) return repeat(o), kDone;
  Experiment chosen = *experiment;
  if (o.record) {
    if (o.name != "touch" || o.out.empty())
      throw ConfigError(
          "--record needs --out DIR and the experiment touch, the only one that is a single run");
    chosen.run = run_touch_recorded;
  }
  ExperimentRun r;
  r.config = config;
  r.seed = o.seed;
  r.out = o.out;
  ProgressLine line(o.quiet);
  r.progress = [&](double done) {
    line.show(o.name + ": " + std::to_string(std::lround(100.0 * done)) + " %", done);
  };
  const auto began = std::chrono::steady_clock::now();
  const auto complain = [](const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); };
  const std::vector<Metric> metrics = run_experiment(chosen, r, complain);
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  line.clear();
  const auto wrong = std::ranges::find_if(metrics, [](const Metric& m) {
    return (m.name == "violations" || (m.name == "never_seen" && full_size())) && m.value > 0.0;
  });
  if (wrong != metrics.end() && o.quiet) throw std::runtime_error("faults: " + wrong->name);
  const std::string_view outcome = outcome_of(metrics);
  const int status = outcome.empty() ? kDone : kNoContact;
  if (o.quiet) return status;
  if (!outcome.empty()) std::printf("outcome: %s\n", std::string(outcome).c_str());
  for (const Metric& m : metrics) {
    std::printf("%-32s %14s %s\n", m.name.c_str(), number(m.value).c_str(), m.unit.c_str());
    if (m.name == "duration_s")
      std::printf("%-32s %14s\n", "times_faster_than_real_time", number(m.value / spent).c_str());
  }
  std::printf("commit %s, config %s, seed %llu%s%s\n", std::string(commit()).c_str(),
              config_hash(r.config).c_str(), static_cast<unsigned long long>(o.seed),
              r.out.empty() ? "" : "; written to ", r.out.c_str());
  if (wrong != metrics.end()) throw std::runtime_error(number(wrong->value) + " " + wrong->name);
  return status;
}

}  // namespace longreach
