#pragma once
// Common parts of the verification programs: their options and exit status.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <string>

#include "common/config/config.hpp"
#include "common/program/option_checks.hpp"
#include "deploy/lab/run.hpp"

namespace longreach {

struct VerificationOptions {
  std::uint64_t seed = 1;
  std::string out;
  bool quiet = false;
};

inline void add_options(CLI::App& app, VerificationOptions& o) {
  app.add_option("--seed", o.seed, "Seed of all random streams")
      ->check(whole_number())
      ->capture_default_str();
  app.add_option("--out", o.out, "Folder for metrics.json and the table; created if missing")
      ->type_name("DIR");
  app.add_flag("--quiet", o.quiet, "Print nothing");
}

/// Runs the experiment and prints its metrics.
inline std::vector<Metric> verify(const Experiment& experiment, const VerificationOptions& o) {
  ExperimentRun run;
  run.config = configure({}, find_deploy_folder());
  run.seed = o.seed;
  run.out = o.out;
  return run_and_print(experiment, run, o.quiet);
}

inline double value_of(const std::vector<Metric>& metrics, std::string_view name) {
  for (const Metric& m : metrics)
    if (m.name == name) return m.value;
  throw std::logic_error("there is no metric " + std::string(name));
}

/// Parses the command line and runs `body`. Returns the exit status: 0 success, 1 failure, 2 invalid option.
inline int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  const auto say = [&app](const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), e.what());
  };
  try {
    app.parse(argc, argv);
    body();
    return 0;
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    say(e);
    return 2;
  } catch (const ConfigError& e) {
    say(e);
    return 2;
  } catch (const std::exception& e) {
    say(e);
    return 1;
  }
}

}  // namespace longreach
