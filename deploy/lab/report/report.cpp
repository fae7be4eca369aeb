#include "deploy/lab/report/report.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/lab/report/page.hpp"

namespace longreach {
namespace {

constexpr const char* kFullSize = "LONGREACH_FULL";  // see deploy/lab/campaign_size.hpp

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::trunc);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::vector<const Experiment*> chosen(const std::vector<std::string>& only) {
  std::vector<const Experiment*> all;
  for (const std::string& name : only) {
    const Experiment* experiment = find_experiment(name);
    if (experiment == nullptr)
      throw ConfigError("unknown experiment '" + name + "'; `longreach-lab list` prints the names");
    all.push_back(experiment);
  }
  if (!only.empty()) return all;
  for (const Experiment& experiment : experiments()) all.push_back(&experiment);
  return all;
}

ReportChapter run_chapter(const Experiment& experiment, const ReportOptions& options) {
  const std::string name(experiment.name);
  ReportChapter chapter;
  chapter.experiment = &experiment;
  chapter.command = std::string(options.quick ? "" : "LONGREACH_FULL=1 ") + "longreach-lab run " + name +
                    (options.seed == 1 ? "" : " --seed " + std::to_string(options.seed));
  try {
    ExperimentRun run;
    run.config = configure({}, find_deploy_folder());
    run.seed = options.seed;
    run.out = options.out / name;
    chapter.config = config_hash(run.config);
    chapter.metrics =
        run_experiment(experiment, run, [](const std::string& why) { throw std::runtime_error(why); });
    for (const Plot& plot : plots_of(experiment, chapter.metrics))
      chapter.pictures.push_back({plot.title, text_of(run.out / (plot.name + ".svg"))});
  } catch (const std::exception& e) {
    chapter.failure = e.what();
  }
  return chapter;
}

}  // namespace

int write_report(const ReportOptions& options) {
  const std::vector<const Experiment*> all = chosen(options.only);
  make_folder(options.out);
  if (options.quick) {
    unsetenv(kFullSize);
  } else {
    setenv(kFullSize, "1", 1);
  }
  std::vector<ReportChapter> chapters;
  int failed = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto began = std::chrono::steady_clock::now();
    std::fprintf(stderr, "[%zu/%zu] %s ", i + 1, all.size(), std::string(all[i]->name).c_str());
    std::fflush(stderr);
    chapters.push_back(run_chapter(*all[i], options));
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const std::string& failure = chapters.back().failure;
    std::fprintf(stderr, "%.1f s%s%s\n", spent, failure.empty() ? "" : ": failed: ", failure.c_str());
    failed += failure.empty() ? 0 : 1;
    // Written after each experiment, so that a long run shows its intermediate results.
    const ReportHead head{std::string(commit()),
                          options.quick ? "small campaigns (--quick)" : "full campaigns", options.seed};
    write(options.out / "index.html", report_page(head, chapters));
    write(options.out / "results.md", report_table(chapters));
  }
  std::fprintf(stderr, "written to %s\n", (options.out / "index.html").c_str());
  return failed;
}

}  // namespace longreach
