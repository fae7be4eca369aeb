// The campaign of faults, by the laboratory (tests/faults/faults.hpp).

#include "tests/faults/faults.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "common/text/number_text.hpp"
#include "deploy/lab/campaign/plan.hpp"
#include "deploy/lab/progress_line.hpp"
#include "tests/programs/verification.hpp"

namespace longreach {
namespace {

struct FaultOptions : VerificationOptions {
  bool seeded = false;   // --seed was given: that one is repeated
  std::string schedule;  // a file
  std::string seeds;     // FIRST:COUNT
};

constexpr const char* kViolated = "an invariant is violated";

/// One seed of the campaign, or what a file says.
void repeat(const FaultOptions& o) {
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
  if (!holds) throw std::runtime_error(kViolated);
}

/// A range of seeds, each judged; none is drawn or kept in a folder.
void run_seeds(const FaultOptions& o) {
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
  std::set<std::uint64_t> failing;
  for (const Failure& failure : tally.failures) failing.insert(failure.seed);
  if (!o.quiet)
    std::printf("%llu seeds from %llu, %.2f virtual hours, %.0f %% engaged: %zu failing seeds\n",
                static_cast<unsigned long long>(tally.seeds), static_cast<unsigned long long>(*first),
                tally.virtual_s / 3600.0, 100.0 * tally.engaged_s / std::max(1.0, tally.virtual_s),
                failing.size());
  if (!tally.failures.empty()) throw std::runtime_error(kViolated);
}

void run_campaign(const Experiment& faults, const FaultOptions& o) {
  const std::vector<Metric> metrics = verify(faults, o);
  if (value_of(metrics, "violations") > 0.0) throw std::runtime_error(kViolated);
  if (full_size() && value_of(metrics, "never_seen") > 0.0)
    throw std::runtime_error("a kind, guard or invariant was never active");
}

}  // namespace
}  // namespace longreach

int main(int argc, char** argv) {
  using namespace longreach;
  const Experiment faults{"faults",
                          "Random, overlapping faults of all kinds in virtual time, checked by an "
                          "independent oracle.",
                          "", run_fault_campaign, faults_plots};
  CLI::App app{
      std::string(faults.summary) +
      "\n\nWithout --seed, --seeds and --schedule: half an hour of virtual time, or 400 hours with "
      "LONGREACH_FULL, "
      "in blocks that are stored in DIR; an interrupted campaign resumes.\n\nExit status: 0 if every "
      "invariant holds, 1 if one is violated, 2 if an option is invalid."};
  app.name("faults");
  FaultOptions options;
  add_options(app, options);
  app.get_option("--seed")->each([&](const std::string&) { options.seeded = true; });
  app.add_option("--schedule", options.schedule, "Faults to inject, as a failing run prints them")
      ->type_name("FILE");
  app.add_option("--seeds", options.seeds, "Seeds to run, COUNT from FIRST on")->type_name("FIRST:COUNT");
  return run_program(app, argc, argv, [&] {
    if (!options.seeds.empty()) return run_seeds(options);
    if (options.seeded || !options.schedule.empty()) return repeat(options);
    run_campaign(faults, options);
  });
}
