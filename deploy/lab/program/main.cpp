// The command line of longreach-lab: experiments in deterministic virtual time. Each subcommand is a function
// in its folder.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "common/config/config.hpp"
#include "common/program/option_checks.hpp"
#include "common/program/program_text.hpp"
#include "deploy/lab/campaign/sweep.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/networks/train.hpp"
#include "deploy/lab/recording/replay.hpp"
#include "deploy/lab/report/report.hpp"
#include "deploy/lab/run.hpp"
#include "deploy/lab/solve/solve.hpp"
#include "deploy/lab/solve/solve_identify.hpp"

namespace longreach {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

/// The parsed options of all subcommands.
struct Options {
  LabRunOptions run;
  SweepOptions sweep;
  MergeOptions merge;
  std::vector<std::string> recordings;
  ReportOptions report;
  std::string kind;  // of question, of device
  IdentifyOptions identify;
  std::uint64_t train_seed = 1;
  std::string train_out = "spherical_network.txtpb";
};

void add_run(CLI::App& app, LabRunOptions& o) {
  CLI::App* run = app.add_subcommand(
      "run",
      "Run one experiment, e.g. `longreach-lab run touch --out out/touch`. A setting that the "
      "experiment does not use is refused.\n\n"
      "Exit status: 0 done, 1 failed, 2 invalid option or setting (nothing was run), 3 no contact (touch).");
  run->add_option("name", o.name, "Experiment")->required();
  run->add_option("--seed", o.seed, "Seed of every random stream")
      ->check(whole_number())
      ->capture_default_str();
  run->add_option("--set", o.settings,
                  "Set a field of the configuration, e.g. --set profile=analog --set mapping.scale=0.2 "
                  "--set scene.material.wall.stiffness_n_per_m=5000; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  run->add_option("--out", o.out, "Folder for metrics.json, traces and plots; created if missing")
      ->type_name("DIR");
  run->add_flag("--record", o.record,
                "Record both sides as the programs do, into DIR/touch.mcap (only touch, with --out); "
                "`longreach-lab replay` can replay it");
  run->add_flag("--quiet", o.quiet, "Print nothing");
}

void add_replay(CLI::App& app, std::vector<std::string>& files) {
  CLI::App* replay = app.add_subcommand(
      "replay",
      "Run the nodes again on the inputs of recordings (`longreach-master --record FILE`, `longreach-slave --record FILE`) and compare their outputs with the recorded outputs, bit for bit.\n\n"
      "Exit status: 0 equal, 1 different (the first difference is printed), 2 not completely replayed (the reason is printed).");
  replay->add_option("files", files, "Recordings")->type_name("FILE...")->required();
}

void add_sweep(CLI::App& app, SweepOptions& o) {
  CLI::App* sweep = app.add_subcommand(
      "sweep",
      "Run a campaign: every experiment with every combination of settings and every seed of a grid, on all processors. After an interruption, run the same command again to resume.\n\n"
      "FILE defines the grid, e.g.\n"
      "  experiment: \"touch\"\n"
      "  setting { path: \"profile\" value: \"moon\" value: \"lab\" }\n"
      "  setting { path: \"scene.material.wall.stiffness_n_per_m\" value: \"500\" value: \"5000\" }\n"
      "  seeds { from: 1 to: 20 }\n"
      "makes 80 cells. Paths and values are those of `longreach-lab run --set PATH=VALUE`. DIR/results.csv has a row per cell, DIR/results.times.csv the results that depend on the machine.\n\n"
      "Exit status: 0 all cells are done, 1 some failed (the same command runs them again), 2 invalid grid or option (nothing was run), 3 all are done, some without contact, 128 and more: stopped by a signal.");
  sweep->add_option("file", o.file, "The grid")->type_name("FILE")->required();
  sweep->add_option("--out", o.out, "Folder of this campaign; default: out/ and the name of FILE")
      ->type_name("DIR");
  sweep->add_option("--jobs", o.jobs, "Parallel cells; 0: one per processor")->capture_default_str();
  sweep
      ->add_option("--shard", o.shard,
                   "Only every N-th cell, from the I-th on: N hosts that run 1/N to N/N share a campaign, "
                   "in one folder or in several; `merge` then writes the results")
      ->type_name("I/N")
      ->capture_default_str();
  sweep->add_flag("--quiet", o.quiet, "Print failures only");
}

void add_merge(CLI::App& app, MergeOptions& o) {
  CLI::App* merge = app.add_subcommand(
      "merge",
      "Write the results of a campaign whose shards are in one or several folders, byte for byte as from a single run. Exit status 1 if cells are missing; they are printed.");
  merge->add_option("folders", o.folders, "Folders of `longreach-lab sweep`")
      ->type_name("DIR...")
      ->required();
  merge->add_option("--out", o.out, "Default: results.csv in the first folder; times go to NAME.times.csv")
      ->type_name("FILE.csv");
}

void add_report(CLI::App& app, ReportOptions& o) {
  CLI::App* report = app.add_subcommand(
      "report",
      "Run all experiments one by one into DIR/NAME, and write DIR/index.html, a self-contained page");
  report->add_option("--out", o.out, "Folder; created if missing")->type_name("DIR")->required();
  report->add_flag("--quick", o.quick, "Small campaigns that take minutes instead of hours");
  report->add_option("--seed", o.seed, "Seed of every random stream")
      ->check(whole_number())
      ->capture_default_str();
  report->add_option("--only", o.only, "Only these experiments")->type_name("NAME...");
}

void add_solve(CLI::App& app, std::string& kind, IdentifyOptions& identify) {
  CLI::App* solve = app.add_subcommand(
      "solve",
      "Answer requests on standard input, one JSON object per line: kinematics of a haptic device or of a "
      "robot; "
      "identify: the stiffness of a contact from samples of t, x, f and, if known, v, also as CSV");
  std::vector<std::string> kinds = solve_kinds();
  kinds.emplace_back("identify");
  solve->add_option("kind", kind, "Kind of request")->required()->check(CLI::IsMember(kinds));
  CLI::Option_group* of_identify = solve->add_option_group("identify");
  of_identify->add_option("--estimator", identify.estimator, "Estimator; all: a summary of each at the end")
      ->check(CLI::IsMember(identify_estimators()))
      ->capture_default_str();
  of_identify->add_option("--exponent", identify.exponent, "Exponent of fixed-exponent")
      ->check(number_between(0.5, 3.5))
      ->capture_default_str();
  of_identify
      ->add_option("--force-noise", identify.force_noise_n,
                   "Standard deviation of the force, N; 0: estimated from the samples")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  of_identify->add_option("--position-noise", identify.position_noise_m, "Likewise, m")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  solve->callback([of_identify, &kind] {
    if (kind != "identify" && of_identify->count_all() > 0)
      throw CLI::ValidationError("solve " + kind, "has no options");
  });
}

void add_train(CLI::App& app, Options& o) {
  CLI::App* train = app.add_subcommand(
      "train",
      "Train the networks of a haptic device's forward kinematics (Levenberg-Marquardt by Ceres Solver, one "
      "thread, a few minutes); the same seed writes the same bytes. deploy/devices/ holds those of seed 1");
  train->add_option("kind", o.kind, "Device")->required()->check(CLI::IsMember(train_kinds()));
  train->add_option("--seed", o.train_seed, "Seed of samples and first weights")
      ->check(whole_number())
      ->capture_default_str();
  train->add_option("--out", o.train_out, "Output file")->type_name("FILE")->capture_default_str();
}

int run_subcommand(const CLI::App& app, const Options& o) {
  if (app.got_subcommand("sweep")) return sweep(o.sweep);
  if (app.got_subcommand("merge")) return merge(o.merge);
  if (app.got_subcommand("replay")) return replay(o.recordings, std::cout, std::cerr);
  if (app.got_subcommand("report")) return write_report(o.report) == 0 ? kDone : kFailed;
  if (app.got_subcommand("solve") && o.kind == "identify")
    return solve_identify(o.identify, std::cin, std::cout, std::cerr);
  if (app.got_subcommand("solve")) return solve(o.kind, std::cin, std::cout);
  if (app.got_subcommand("train")) train(o.kind, o.train_seed, o.train_out);
  if (app.got_subcommand("list")) list_experiments();
  if (app.got_subcommand("run")) return run(o.run);
  return kDone;
}

}  // namespace
}  // namespace longreach

int main(int argc, char** argv) {
  CLI::App app{"Experiments with both nodes of longreach in deterministic virtual time."};
  app.name("longreach-lab");
  app.set_version_flag("--version", std::string(longreach::commit()));
  longreach::add_manual_options(app, "longreach-lab " + std::string(longreach::commit()));
  app.require_subcommand(1);
  app.add_subcommand("list", "List the experiments");
  longreach::Options options;
  longreach::add_run(app, options.run);
  longreach::add_sweep(app, options.sweep);
  longreach::add_merge(app, options.merge);
  longreach::add_replay(app, options.recordings);
  longreach::add_report(app, options.report);
  longreach::add_solve(app, options.kind, options.identify);
  longreach::add_train(app, options);
  longreach::refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::RequiredError& e) {
    const bool other = app.get_subcommands().empty() && !app.remaining().empty();
    std::fprintf(stderr, "longreach-lab: %s; --help shows the commands\n",
                 other ? (app.remaining().front() + " is not a command").c_str() : e.what());
    return longreach::kBadUsage;
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "longreach-lab: %s; --help shows the options\n", e.what());
    return longreach::kBadUsage;
  }
  try {
    return longreach::run_subcommand(app, options);
  } catch (const longreach::ConfigError& e) {
    std::fprintf(stderr, "longreach-lab: %s\n", e.what());
    return longreach::kBadUsage;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "longreach-lab: %s\n", e.what());
    return longreach::kFailed;
  }
}
