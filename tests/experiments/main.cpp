// longreach-lab: experiments in deterministic virtual time.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "common/config/config.hpp"
#include "tests/experiments/experiment.hpp"
#include "tests/experiments/report/report.hpp"
#include "tests/experiments/solve.hpp"
#include "tests/experiments/solve_identify.hpp"
#include "tests/experiments/train.hpp"

namespace longreach {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

struct RunOptions {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> settings;
  std::string out;
  bool quiet = false;
};

int list() {
  for (const Experiment& e : experiments()) {
    const std::string figure = e.figure.empty() ? "" : " (" + std::string(e.figure) + ")";
    std::printf("%-16s %s%s\n", std::string(e.name).c_str(), std::string(e.summary).c_str(), figure.c_str());
  }
  return kDone;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Progress on a terminal only, rewritten in place.
std::function<void(double)> progress_line(const RunOptions& o, double virtual_s) {
  if (o.quiet || !isatty(STDERR_FILENO)) return {};
  const auto began = std::chrono::steady_clock::now();
  return [began, virtual_s, name = o.name](double done) {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    std::fprintf(stderr, "\r%s: %3.0f %% of at most %g s, %.0f times faster than real time ", name.c_str(),
                 100.0 * done, virtual_s, done * virtual_s / std::max(spent, 1e-9));
    if (done >= 1.0) std::fprintf(stderr, "\r\033[K");
  };
}

int run(const RunOptions& o) {
  const Experiment* experiment = find_experiment(o.name);
  if (!experiment) {
    std::fprintf(stderr, "longreach-lab: there is no experiment '%s'; `longreach-lab list` shows them\n",
                 o.name.c_str());
    return kBadUsage;
  }
  ExperimentRun r;
  try {
    r.config = configure(o.settings, find_deploy_folder());
  } catch (const ConfigError& e) {
    std::fprintf(stderr, "longreach-lab: %s\n", e.what());
    return kBadUsage;
  }
  r.seed = o.seed;
  r.out = o.out;
  r.progress = progress_line(o, r.config.duration_s());
  const auto began = std::chrono::steady_clock::now();
  const auto complain = [](const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); };
  const std::vector<Metric> metrics = run_experiment(*experiment, r, complain);
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (o.quiet) return kDone;
  for (const Metric& m : metrics) {
    std::printf("%-32s %14s %s\n", m.name.c_str(), number(m.value).c_str(), m.unit.c_str());
    if (m.name == "duration_s")
      std::printf("%-32s %14s\n", "times_faster_than_real_time", number(m.value / spent).c_str());
  }
  std::printf("commit %s, config %s, seed %llu%s%s\n", std::string(commit()).c_str(),
              config_hash(r.config).c_str(), static_cast<unsigned long long>(o.seed),
              r.out.empty() ? "" : "; written to ", r.out.c_str());
  return kDone;
}

void add_report(CLI::App& app, ReportOptions& o) {
  CLI::App* report = app.add_subcommand(
      "report",
      "Run all experiments, one after the other, into DIR/NAME, and write DIR/index.html, one page that "
      "needs no other file");
  report->add_option("--out", o.out, "Folder; made if missing")->type_name("DIR")->required();
  report->add_flag("--quick", o.quick, "Small campaigns: minutes instead of hours");
  report->add_option("--seed", o.seed, "Seed of every random stream")->capture_default_str();
  report->add_option("--only", o.only, "Only these experiments")->type_name("NAME...");
}

void add_solve(CLI::App& app, std::string& kind, IdentifyOptions& identify) {
  CLI::App* solve = app.add_subcommand(
      "solve",
      "Answer questions on standard input, one JSON object a line: kinematics of a haptic device or of a "
      "robot; "
      "identify: the stiffness of a contact from samples of t, x, f and, if known, v, also as CSV");
  std::vector<std::string> kinds = solve_kinds();
  kinds.emplace_back("identify");
  solve->add_option("kind", kind, "Kind of question")->required()->check(CLI::IsMember(kinds));
  CLI::Option_group* of_identify = solve->add_option_group("identify");
  of_identify->add_option("--estimator", identify.estimator, "Estimator; all: a summary of each at the end")
      ->check(CLI::IsMember(identify_estimators()))
      ->capture_default_str();
  of_identify->add_option("--exponent", identify.exponent, "Exponent of fixed-exponent")
      ->check(CLI::Range(0.5, 3.5))
      ->capture_default_str();
  of_identify
      ->add_option("--force-noise", identify.force_noise_n, "Standard deviation, N; 0: from the samples")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  of_identify->add_option("--position-noise", identify.position_noise_m, "Likewise, m")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  solve->callback([of_identify, &kind] {
    if (kind != "identify" && of_identify->count_all() > 0)
      throw CLI::ValidationError("solve " + kind, "has no options");
  });
}

}  // namespace
}  // namespace longreach

int main(int argc, char** argv) {
  using longreach::RunOptions;
  CLI::App app{"Experiments with both nodes of longreach in deterministic virtual time."};
  app.set_version_flag("--version", std::string(longreach::commit()));
  app.require_subcommand(1);
  app.add_subcommand("list", "Show the experiments");
  std::string kind;
  longreach::IdentifyOptions identify;
  longreach::add_solve(app, kind, identify);
  longreach::ReportOptions report;
  longreach::add_report(app, report);
  std::uint64_t train_seed = 1;
  std::string train_out = "spherical_network.txtpb";
  CLI::App* train = app.add_subcommand(
      "train",
      "Train the networks of a haptic device's forward kinematics (Levenberg-Marquardt by Ceres Solver, one "
      "thread, a few minutes); the same seed writes the same bytes. deploy/devices/ holds those of seed 1");
  train->add_option("kind", kind, "Device")->required()->check(CLI::IsMember(longreach::train_kinds()));
  train->add_option("--seed", train_seed, "Seed of samples and first weights")->capture_default_str();
  train->add_option("--out", train_out, "File that is written")->type_name("FILE")->capture_default_str();
  RunOptions o;
  CLI::App* run =
      app.add_subcommand("run", "Run one experiment, e.g. `longreach-lab run touch --out out/touch`");
  run->add_option("name", o.name, "Experiment")->required();
  run->add_option("--seed", o.seed, "Seed of every random stream")->capture_default_str();
  run->add_option("--set", o.settings,
                  "Set a field of the configuration, e.g. --set profile=analog --set mapping.scale=0.2 "
                  "--set scene.material.wall.stiffness_n_per_m=5000; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  run->add_option("--out", o.out, "Folder for metrics.json, traces and plots; made if missing")
      ->type_name("DIR");
  run->add_flag("--quiet", o.quiet, "Print nothing");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    return status == 0 ? 0 : longreach::kBadUsage;
  }
  try {
    if (app.got_subcommand("train")) {
      longreach::train(kind, train_seed, train_out);
      return longreach::kDone;
    }
    if (app.got_subcommand("report"))
      return longreach::write_report(report) == 0 ? longreach::kDone : longreach::kFailed;
    if (app.got_subcommand("solve") && kind == "identify")
      return longreach::solve_identify(identify, std::cin, std::cout, std::cerr);
    if (app.got_subcommand("solve")) return longreach::solve(kind, std::cin, std::cout);
    return app.got_subcommand("list") ? longreach::list() : longreach::run(o);
  } catch (const longreach::ConfigError& e) {
    std::fprintf(stderr, "longreach-lab: %s\n", e.what());
    return longreach::kBadUsage;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "longreach-lab: %s\n", e.what());
    return longreach::kFailed;
  }
}
