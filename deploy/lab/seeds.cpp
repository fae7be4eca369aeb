#include "deploy/lab/seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/progress_line.hpp"
#include "deploy/lab/run.hpp"

namespace longreach {
namespace {

constexpr int kPassed = 0, kFailedSeed = 1, kSeedWithoutContact = 3;
constexpr std::uint64_t kSeedsMost = 100'000;  // more are a typing error: at one second each, they take a day

double excess(const TrialCheck& c) {
  const double over = c.value - c.most;
  return c.most == 0.0 ? over : over / std::abs(c.most);
}

struct SeedResult {
  std::uint64_t seed = 0;
  std::vector<Metric> metrics{};
  std::size_t checks = 0;
  std::vector<TrialCheck> failed{};
  std::string error{};
  bool done = false;

  [[nodiscard]] bool passed() const { return error.empty() && failed.empty(); }
  [[nodiscard]] std::string text() const {
    std::string all = "seed " + std::to_string(seed) + ": ";
    if (!error.empty()) return all + "failed: " + error + "\n";
    if (const std::string_view outcome = outcome_of(metrics); !outcome.empty())
      return all + std::string(outcome) + "\n";
    if (failed.empty())
      return all + (checks > 0 ? "passed, " + std::to_string(checks) + " checks\n" : "done\n");
    all += "failed, " + std::to_string(failed.size()) + " of " + std::to_string(checks) + " checks\n";
    for (const TrialCheck& c : failed) all += "  " + describe(c) + '\n';
    return all;
  }
  static std::string describe(const TrialCheck& c) {
    return c.trial + ": " + c.what + ": " + metric_text(c.value) + ", permitted " + metric_text(c.most);
  }
};

SeedResult run_seed(const Experiment& experiment, ExperimentRun run,
                    const std::function<void(const std::string&)>& trouble) {
  SeedResult result{.seed = run.seed};
  run.check = [&](const TrialCheck& c) {
    ++result.checks;
    if (!c.holds()) result.failed.push_back(c);
  };
  if (!run.out.empty()) run.out /= std::to_string(run.seed);
  try {
    result.metrics = run_experiment(experiment, run, trouble);
  } catch (const ConfigError&) {
    throw;  // it would be the same with every seed
  } catch (const std::exception& e) {
    result.error = e.what();
  }
  return result;
}

void print_worst(const std::vector<SeedResult>& results) {
  const SeedResult* of = nullptr;
  const TrialCheck* worst = nullptr;
  for (const SeedResult& r : results) {
    for (const TrialCheck& c : r.failed) {
      if (!worst || excess(c) > excess(*worst)) worst = &c, of = &r;
    }
  }
  if (worst)
    std::printf("worst: seed %llu, %s\n", static_cast<unsigned long long>(of->seed),
                SeedResult::describe(*worst).c_str());
}

/// Prints the smallest and the largest value, with their seeds, of each metric that is not the same for all seeds.
void print_ranges(const std::vector<SeedResult>& results) {
  struct Range {
    const Metric *least, *most;
    std::uint64_t least_seed, most_seed;
  };
  std::map<std::string, Range> ranges;
  std::vector<std::string> names;  // in the order of the experiment
  for (const SeedResult& r : results) {
    for (const Metric& m : r.metrics) {
      const auto [at, first] = ranges.try_emplace(m.name, Range{&m, &m, r.seed, r.seed});
      if (first) names.push_back(m.name);
      Range& range = at->second;
      if (m.value < range.least->value) range.least = &m, range.least_seed = r.seed;
      if (m.value > range.most->value) range.most = &m, range.most_seed = r.seed;
    }
  }
  std::erase_if(names, [&](const std::string& name) {
    return ranges.at(name).least->value == ranges.at(name).most->value;
  });
  if (!names.empty())
    std::printf("%-32s %14s %8s %14s %8s\n", "metric", "minimum", "seed", "maximum", "seed");
  for (const std::string& name : names) {
    const Range& r = ranges.at(name);
    std::printf("%-32s %14s %8llu %14s %8llu %s\n", name.c_str(), metric_text(r.least->value).c_str(),
                static_cast<unsigned long long>(r.least_seed), metric_text(r.most->value).c_str(),
                static_cast<unsigned long long>(r.most_seed), r.least->unit.c_str());
  }
}

}  // namespace

SeedRange seed_range(const std::string& text) {
  const auto colon = text.find(':');
  const auto first = parse_integer<std::uint64_t>(text.substr(0, colon));
  const auto last = colon == std::string::npos ? first : parse_integer<std::uint64_t>(text.substr(colon + 1));
  if (!first || !last)
    throw ConfigError("--seeds " + text + " is not a range of seeds; write A:B, for example --seeds 1:20");
  if (*first > *last) throw ConfigError("--seeds " + text + ": the first seed is greater than the last");
  if (*last - *first >= kSeedsMost)
    throw ConfigError("--seeds " + text + " has more than " + std::to_string(kSeedsMost) + " seeds");
  return {*first, *last};
}

int run_seeds(const Experiment& experiment, const ExperimentRun& run, SeedRange seeds, bool quiet) {
  const std::size_t count = seeds.last - seeds.first + 1;
  const std::string name(experiment.name);
  std::vector<SeedResult> results(count);
  std::vector<double> done(count, 0.0);
  std::size_t printed = 0;
  std::mutex mutex;
  ProgressLine line(quiet);
  on_all_cores(count, [&](std::size_t i) {
    ExperimentRun one = run;
    one.seed = seeds.first + i;
    one.progress = [&, i](double share) {
      const std::scoped_lock lock(mutex);
      done[i] = share;
      double sum = 0.0;
      for (const double d : done) sum += d;
      const auto of_seeds = std::to_string(printed) + " of " + std::to_string(count) + " seeds";
      line.show(name + ": " + of_seeds, sum / static_cast<double>(count));
    };
    SeedResult result = run_seed(experiment, one, [&](const std::string& why) {
      const std::scoped_lock lock(mutex);
      std::fprintf(stderr, "%s\n", why.c_str());
    });
    const std::scoped_lock lock(mutex);
    done[i] = 1.0;
    results[i] = std::move(result);
    results[i].done = true;
    line.clear();
    for (; printed < count && results[printed].done; ++printed) {
      if (!quiet) std::printf("%s", results[printed].text().c_str());
    }
    std::fflush(stdout);
  });
  line.clear();
  const auto failed = static_cast<std::size_t>(
      std::ranges::count_if(results, [](const SeedResult& r) { return !r.passed(); }));
  if (!quiet) {
    print_worst(results);
    print_ranges(results);
    std::printf("%zu of %zu seeds failed; commit %s, config %s%s%s\n", failed, count,
                std::string(commit()).c_str(), config_hash(run.config).c_str(),
                run.out.empty() ? "" : "; written to ", run.out.c_str());
  }
  if (failed > 0) return kFailedSeed;
  const auto no_contact = [](const SeedResult& r) { return !outcome_of(r.metrics).empty(); };
  return std::ranges::any_of(results, no_contact) ? kSeedWithoutContact : kPassed;
}

}  // namespace longreach
