#include "deploy/lab/campaign/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/campaign/campaign_folder.hpp"
#include "deploy/lab/campaign/child_processes.hpp"
#include "deploy/lab/campaign/plan.hpp"
#include "deploy/lab/campaign/results.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/progress_line.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

std::size_t jobs_of(const SweepOptions& options) {
  constexpr int kJobsMax = 1024;
  if (options.jobs < 0 || options.jobs > kJobsMax)
    throw ConfigError("--jobs " + std::to_string(options.jobs) +
                      " must be between 0 (one per processor) and " + std::to_string(kJobsMax));
  if (options.jobs > 0) return static_cast<std::size_t>(options.jobs);
  return std::max(1U, std::thread::hardware_concurrency());  // number of processors that this process may use
}

/// Runs one cell in a child process.
void run_cell(const Plan& plan, const CampaignFolder& folder, const fs::path& deploy, std::size_t number) {
  const Cell cell = plan.grid.cell(number);
  ExperimentRun run;
  run.config = configure(plan.grid.settings(cell), deploy, plan.folder);
  run.seed = cell.seed;
  proto::CellRecord result;
  result.set_config(config_hash(run.config));
  if (result.config() != plan.configs[cell.combination])
    throw std::runtime_error("the files in " + deploy.string() + " have changed since the campaign began");
  const auto began = Clock::now();
  for (const Metric& m : find_experiment(cell.experiment)->run(run)) {
    auto& metric = *result.add_metric();
    metric.set_name(m.name);
    metric.set_value(m.value);
    metric.set_unit(m.unit);
    if (m.of_machine) metric.set_of_machine(true);
  }
  result.set_spent_s(seconds_since(began));
  folder.write(number, std::move(result));
}

/// Reports failures and progress while cells run.
class Progress {
 public:
  Progress(const Grid& grid, std::size_t cells, bool quiet) : grid_(grid), cells_(cells), line_(quiet) {}

  void ended(std::size_t cell, const std::string& failure) {
    ++ended_;
    if (!failure.empty()) {
      ++failed_;
      line_.clear();
      std::fprintf(stderr, "cell %zu failed: %s: %s\n", cell, grid_.name(grid_.cell(cell)).c_str(),
                   failure.c_str());
    }
    show();
  }
  void show() {
    std::string what = "sweep: " + std::to_string(ended_) + " of " + std::to_string(cells_) + " cells";
    if (failed_ > 0) what += ", " + std::to_string(failed_) + " failed";
    line_.show(what, static_cast<double>(ended_) / static_cast<double>(cells_));
  }
  void clear() { line_.clear(); }
  [[nodiscard]] std::size_t failed() const { return failed_; }

 private:
  const Grid& grid_;
  std::size_t cells_;
  ProgressLine line_;
  std::size_t ended_ = 0, failed_ = 0;
};

CellResults results_in(const CampaignFolder& folder, std::size_t cells) {
  CellResults results(cells);
  for (std::size_t i = 0; i < cells; ++i) results[i] = folder.result(i);
  return results;
}

/// Writes the results of a complete campaign, or prints how to merge the shards.
void finish(const SweepOptions& options, const Plan& plan, const CampaignFolder& folder, const Shard& shard) {
  if (shard.count > 1) {
    if (!options.quiet)
      std::printf(
          "When all shards are done, run `longreach-lab merge %s`, adding the folders of the other "
          "shards, if any.\n",
          folder.path().c_str());
    return;
  }
  const fs::path file = folder.path() / "results.csv";
  write_results(file, plan.record, results_in(folder, plan.grid.size()));
  if (!options.quiet)
    std::printf("results written to %s, times to %s\n", file.c_str(), times_file(file).c_str());
}

/// Number of completed cells without contact.
std::size_t without_contact(const CellResults& results) {
  return static_cast<std::size_t>(std::ranges::count_if(results, [](const auto& cell) {
    return cell && std::ranges::any_of(cell->metric(), [](const proto::CellRecord::Metric& m) {
             return m.name() == "contact" && m.value() == 0.0;
           });
  }));
}

/// Compares the metrics of two results, except for times.
bool alike(proto::CellRecord a, proto::CellRecord b) {
  const auto without_times = [](proto::CellRecord& record) {
    record.clear_spent_s();
    for (auto& metric : *record.mutable_metric()) {
      if (metric.of_machine()) metric.clear_value();
    }
    return record.SerializeAsString();
  };
  return without_times(a) == without_times(b);
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash != std::string::npos) {
    const auto index = parse_integer<std::size_t>(std::string_view(text).substr(0, slash));
    const auto count = parse_integer<std::size_t>(std::string_view(text).substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count) return {*index, *count};
  }
  throw ConfigError("--shard " + text +
                    " is not a valid shard; write I/N, e.g. 1/4, 2/4, 3/4 and 4/4 on four hosts");
}

int sweep(const SweepOptions& options) {
  const Shard shard = parse_shard(options.shard);
  const std::size_t jobs = jobs_of(options);
  const fs::path deploy = find_deploy_folder();
  const Plan plan = load_plan(options.file, deploy);
  const CampaignFolder folder(options.out.empty() ? "out" / options.file.stem() : options.out, plan.record);
  std::vector<std::size_t> cells;
  std::size_t of_shard = 0;
  for (std::size_t i = shard.index - 1; i < plan.grid.size(); i += shard.count) {
    ++of_shard;
    if (!folder.result(i)) cells.push_back(i);
  }
  Progress progress(plan.grid, cells.size(), options.quiet);
  const ChildWork work{.run = [&](std::size_t cell) { run_cell(plan, folder, deploy, cell); },
                       .ended = [&](std::size_t cell, const std::string& why) { progress.ended(cell, why); },
                       .waited = [&] { progress.show(); }};
  const int signal = run_in_children(cells, jobs, work);
  progress.clear();
  const std::size_t before = of_shard - cells.size();
  if (signal != 0) {
    // Some children may have ended in the meantime.
    const auto now =
        std::ranges::count_if(cells, [&](std::size_t i) { return folder.result(i).has_value(); });
    std::fprintf(stderr,
                 "longreach-lab: stopped (%s) with %zu of %zu cells done; run the same command "
                 "again to resume\n",
                 strsignal(signal), before + static_cast<std::size_t>(now), of_shard);
    return 128 + signal;
  }
  if (!options.quiet)
    std::printf("%zu cells: %zu were already done, %zu were run, %zu of these failed; commit %s\n", of_shard,
                before, cells.size(), progress.failed(), plan.record.commit().c_str());
  const std::size_t no_contact = without_contact(results_in(folder, plan.grid.size()));
  if (no_contact > 0 && !options.quiet) std::printf("outcome: no contact in %zu cells\n", no_contact);
  finish(options, plan, folder, shard);
  if (progress.failed() > 0)
    std::fprintf(stderr, "longreach-lab: %zu of %zu cells failed; run the same command again to retry them\n",
                 progress.failed(), of_shard);
  if (progress.failed() > 0) return 1;
  return no_contact > 0 ? 3 : 0;
}

int merge(const MergeOptions& options) {
  std::vector<CampaignFolder> folders;
  for (const fs::path& path : options.folders) {
    folders.emplace_back(path);
    const std::string why = difference(folders.back().record(), folders.front().record());
    if (!why.empty())
      throw ConfigError(path.string() + " does not match " + options.folders.front().string() +
                        ": its results are " + why);
  }
  const Grid grid(folders.front().record().campaign());
  CellResults results(grid.size());
  for (const CampaignFolder& folder : folders) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto result = folder.result(i);
      if (result && results[i] && !alike(*result, *results[i]))
        throw ConfigError("cell " + std::to_string(i) + " (" + grid.name(grid.cell(i)) + ") in " +
                          folder.path().string() +
                          " differs between the folders; check whether the hosts have different "
                          "processors or C libraries");
      if (result) results[i] = result;
    }
  }
  const fs::path out = options.out.empty() ? options.folders.front() / "results.csv" : options.out;
  write_results(out, folders.front().record(), results);
  const std::size_t missing = complain_of_missing(grid, results);
  std::printf("%zu of %zu cells written to %s, times to %s\n", grid.size() - missing, grid.size(),
              out.c_str(), times_file(out).c_str());
  return missing > 0 ? 1 : 0;
}

}  // namespace longreach
