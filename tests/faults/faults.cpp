#include "tests/faults/faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "deploy/lab/campaign/campaign_folder.hpp"
#include "deploy/lab/campaign/plan.hpp"
#include "tests/faults/faults_table.hpp"
#include "tests/faults/kind.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBlock = 100;  // seeds
constexpr double kHour_s = 3600.0;
constexpr double kFull_h = 400.0, kSmall_h = 0.5;

/// A block that was run before by this program, if it is there as a whole.
std::optional<Tally> kept(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string first;
  if (!stream || !std::getline(stream, first) || first != "commit " + program_name()) return std::nullopt;
  std::ostringstream rest;
  rest << stream.rdbuf();
  return parse_tally(rest.str());
}

Tally block(const ExperimentRun& run, std::uint64_t number, const std::function<void(double)>& progress) {
  const std::uint64_t first = run.seed + number * kBlock;
  if (run.out.empty()) return run_faults(first, kBlock, progress);
  const fs::path file = run.out / "blocks" / (std::to_string(first) + ".txt");
  if (std::optional<Tally> before = kept(file)) return *before;
  Tally tally = run_faults(first, kBlock, progress);
  make_folder(file.parent_path());
  write_whole(file, "commit " + program_name() + "\n" + to_text(tally));
  return tally;
}

double least(const std::map<std::string, std::uint64_t>& counts) {
  const auto at = std::ranges::min_element(counts, {}, [](const auto& entry) { return entry.second; });
  return at == counts.end() ? 0.0 : static_cast<double>(at->second);
}
double sum(const std::map<std::string, std::uint64_t>& counts) {
  double all = 0.0;
  for (const auto& [name, times] : counts) all += static_cast<double>(times);
  return all;
}

std::vector<Metric> metrics_of(const Tally& t) {
  return {{"virtual_hours", t.virtual_s / kHour_s, "h"},
          {"engaged_share", t.engaged_s / std::max(t.virtual_s, 1.0), ""},
          {"seeds", static_cast<double>(t.seeds), ""},
          {"kinds", static_cast<double>(t.kinds.size()), ""},
          {"injected", sum(t.kinds), ""},
          {"injected_least", least(t.kinds), ""},
          {"guards", static_cast<double>(t.guards.size()), ""},
          {"guards_acted", sum(t.guards), ""},
          {"invariants", static_cast<double>(t.judged.size()), ""},
          {"judged", sum(t.judged), ""},
          {"judged_least", least(t.judged), ""},
          {"violations", sum(t.violated), ""},
          {"failing_seeds", static_cast<double>(t.failures.size()), ""},
          {"never_seen", static_cast<double>(never_seen(t).size()), ""}};
}

}  // namespace

void say_failures(const Tally& tally) {
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(kMost, tally.failures.size()); ++i) {
    const Failure& f = tally.failures[i];
    std::fprintf(stderr, "%s violated at %.3f s: %s; repeat it: faults --seed %llu\n",
                 f.violation.invariant.c_str(), f.violation.t_s, f.violation.words.c_str(),
                 static_cast<unsigned long long>(f.seed));
  }
}

// The experiment draws its table itself.
std::vector<Plot> faults_plots() {
  Plot plot;
  plot.name = "faults";
  plot.title = "Faults that were injected, guards that acted, invariants that held";
  return {plot};
}

std::vector<Metric> run_fault_campaign(const ExperimentRun& run) {
  const double wanted_s = kHour_s * (full_size() ? kFull_h : kSmall_h);
  Tally tally;
  for (std::uint64_t number = 0; tally.virtual_s < wanted_s; ++number) {
    const double done = tally.virtual_s / wanted_s;
    const double share = number == 0 ? kBlock * 35.0 / wanted_s : done / static_cast<double>(number);
    tally.add(block(run, number, [&](double of_block) {
      if (run.progress) run.progress(std::min(0.999, done + share * of_block));
    }));
  }
  if (!run.out.empty()) write_faults(run.out, tally);
  say_failures(tally);
  for (const std::string& what : never_seen(tally)) std::fprintf(stderr, "never seen: %s\n", what.c_str());
  return metrics_of(tally);
}

}  // namespace longreach
