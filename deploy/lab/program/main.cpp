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
#include "deploy/lab/mjcf_robots.hpp"
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
      "Run one experiment, e.g. `longreach-lab run touch --out out/touch`. Settings that the "
      "experiment does not use are rejected.\n\n"
      "Exit status: 0 on success, 1 on failure, also of a single seed, 2 if an option or setting is invalid "
      "(nothing was run), 3 if there was no contact (touch only).");
  run->add_option("name", o.name, "Experiment")->required();
  CLI::Option* seed = run->add_option("--seed", o.seed, "Seed of all random streams")
                          ->check(whole_number())
                          ->capture_default_str();
  run->add_option(
         "--seeds", o.seeds,
         "Run once with each seed from A to B, on all processors, and print which seeds failed, the "
         "worst check, and the range of each metric that varies. --out writes the files of each seed to DIR/SEED")
      ->type_name("A:B")
      ->excludes(seed);
  run->add_option("--only", o.only,
                  "Run only the trials whose names contain TEXT, e.g. --only slot,kontur (person only)")
      ->type_name("TEXT");
  run->add_option("--set", o.settings,
                  "Set a field of the configuration, e.g. --set profile=analog --set "
                  "mapping.scale=0.2 --set scene.material.wall.stiffness_n_per_m=5000; can be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  run->add_option("--out", o.out, "Folder for metrics.json, traces and plots; created if missing")
      ->type_name("DIR");
  run->add_flag("--record", o.record,
                "Record both sides into DIR/touch.mcap, as the programs do, for `longreach-lab "
                "replay` (touch only, requires --out)");
  run->add_flag("--quiet", o.quiet, "Print nothing");
}

void add_replay(CLI::App& app, std::vector<std::string>& files) {
  CLI::App* replay = app.add_subcommand(
      "replay",
      "Run the nodes again on recorded inputs (`longreach-master --record FILE`, `longreach-slave "
      "--record FILE`) and compare their outputs with the recorded outputs bit by bit.\n\n"
      "Exit status: 0 if all outputs are equal, 1 if they differ (the first difference is printed), 2 if "
      "the replay is incomplete (the reason is printed).");
  replay->add_option("files", files, "Recordings")->type_name("FILE...")->required();
}

void add_sweep(CLI::App& app, SweepOptions& o) {
  CLI::App* sweep = app.add_subcommand(
      "sweep",
      "Run a campaign: every experiment of a grid with every combination of settings and every seed, "
      "on all processors. To resume after an interruption, run the same command again.\n\n"
      "FILE defines the grid, e.g.\n"
      "  experiment: \"touch\"\n"
      "  setting { path: \"profile\" value: \"moon\" value: \"lab\" }\n"
      "  setting { path: \"scene.material.wall.stiffness_n_per_m\" value: \"500\" value: \"5000\" }\n"
      "  seeds { from: 1 to: 20 }\n"
      "defines 80 cells. Paths and values are the same as in `longreach-lab run --set PATH=VALUE`. "
      "DIR/results.csv has one row per cell; DIR/results.times.csv contains the results that depend "
      "on the machine.\n\n"
      "Exit status: 0 if all cells are done, 1 if some failed (the same command retries them), 2 if "
      "the grid or an option is invalid (nothing was run), 3 if all are done but some had no contact, "
      "128 or more if a signal stopped the campaign.");
  sweep->add_option("file", o.file, "File that defines the grid")->type_name("FILE")->required();
  sweep->add_option("--out", o.out, "Folder of this campaign; default: out/ followed by the name of FILE")
      ->type_name("DIR");
  sweep->add_option("--jobs", o.jobs, "Number of cells to run in parallel; 0: one per processor")
      ->capture_default_str();
  sweep
      ->add_option("--shard", o.shard,
                   "Run only every N-th cell, starting with the I-th. N hosts that run 1/N to N/N share a "
                   "campaign, in one or more folders; `merge` then writes the results")
      ->type_name("I/N")
      ->capture_default_str();
  sweep->add_flag("--quiet", o.quiet, "Print only failures");
}

void add_merge(CLI::App& app, MergeOptions& o) {
  CLI::App* merge = app.add_subcommand(
      "merge",
      "Write the results of a campaign that was run in shards, in one or more folders. The results "
      "are byte-for-byte identical to those of a single run.\n\n"
      "Exit status: 0 if all cells are present, 1 if some are missing (they are listed).");
  merge->add_option("folders", o.folders, "Folders written by `longreach-lab sweep`")
      ->type_name("DIR...")
      ->required();
  merge
      ->add_option("--out", o.out,
                   "Output file; default: results.csv in the first folder. Times are "
                   "written to NAME.times.csv")
      ->type_name("FILE.csv");
}

void add_report(CLI::App& app, ReportOptions& o) {
  CLI::App* report = app.add_subcommand(
      "report",
      "Run all experiments one after the other, write the files of each to DIR/NAME, and create a "
      "self-contained page, DIR/index.html");
  report->add_option("--out", o.out, "Output folder; created if missing")->type_name("DIR")->required();
  report->add_flag("--quick", o.quick, "Run small campaigns, which take minutes instead of hours");
  report->add_option("--seed", o.seed, "Seed of all random streams")
      ->check(whole_number())
      ->capture_default_str();
  report->add_option("--only", o.only, "Run only these experiments")->type_name("NAME...");
}

void add_solve(CLI::App& app, std::string& kind, IdentifyOptions& identify) {
  CLI::App* solve = app.add_subcommand(
      "solve",
      "Process requests from standard input, one JSON object per line: the kinematics of a haptic device "
      "or robot, or an impact. `identify` estimates the stiffness of a contact from samples of t, x, f "
      "and optionally v, as JSON or CSV");
  std::vector<std::string> kinds = solve_kinds();
  kinds.emplace_back("identify");
  solve->add_option("kind", kind, "Kind of request")->required()->check(CLI::IsMember(kinds));
  CLI::Option_group* of_identify = solve->add_option_group("identify");
  of_identify
      ->add_option("--estimator", identify.estimator,
                   "Estimator; all: print a summary of every estimator at the end")
      ->check(CLI::IsMember(identify_estimators()))
      ->capture_default_str();
  of_identify->add_option("--exponent", identify.exponent, "Exponent assumed by the fixed-exponent estimator")
      ->check(number_between(0.5, 3.5))
      ->capture_default_str();
  of_identify
      ->add_option("--force-noise", identify.force_noise_n,
                   "Standard deviation of the force noise, N; 0: estimate it from the samples")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  of_identify
      ->add_option(
          "--depth", identify.depth_m,
          "Depth at which stiffness and secant are evaluated, m; default: the current depth, and in free "
          "space the largest one")
      ->check(number_above_zero())
      ->type_name("M");
  of_identify
      ->add_option("--position-noise", identify.position_noise_m,
                   "Standard deviation of the position noise, m")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  solve->callback([of_identify, &kind] {
    if (kind != "identify" && of_identify->count_all() > 0)
      throw CLI::ValidationError("solve " + kind, "does not accept the options of identify");
  });
}

void add_train(CLI::App& app, Options& o) {
  CLI::App* train = app.add_subcommand(
      "train",
      "Train the networks for the forward kinematics of a haptic device (Levenberg-Marquardt in Ceres "
      "Solver, one thread, a few minutes). The same seed always gives the same file; deploy/devices/ "
      "contains the networks of seed 1");
  train->add_option("kind", o.kind, "Device")->required()->check(CLI::IsMember(train_kinds()));
  train->add_option("--seed", o.train_seed, "Seed of the samples and the initial weights")
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
  CLI::App app{"Run experiments with longreach's master and slave in deterministic virtual time."};
  app.name("longreach-lab");
  app.set_version_flag("--version", std::string(longreach::commit()));
  longreach::add_manual_options(app, "longreach-lab " + std::string(longreach::commit()));
  app.require_subcommand(1);
  app.add_subcommand("list", "List the experiments");
  longreach::use_mujoco();
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
