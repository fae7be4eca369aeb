#pragma once
// The parts that both programs share outside their loops: options, configuration and exit status. Include
// this header only in main.cpp, because CLI11 takes seconds to compile.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/effective.hpp"
#include "common/net/address.hpp"
#include "common/program/async_writer.hpp"
#include "common/program/core_dumps.hpp"
#include "common/program/log.hpp"
#include "common/program/option_checks.hpp"
#include "common/program/program_text.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/recording_folder.hpp"
#include "common/site/revocations.hpp"
#include "common/site/site.hpp"

namespace longreach {

constexpr int kExitFailed = 1;    // the program could not start, or the run failed its checks
constexpr int kExitBadUsage = 2;  // invalid options or configuration

struct ProgramOptions {
  std::string config;
  std::vector<std::string> settings;  // path=value
  std::string profile;
  std::optional<double> seconds{};
  std::string log;
  std::string site;
  std::string record;
  std::string recordings;
  double record_max_mb = kRecordMaxMb;
  bool insecure = false;
  bool check = false;
  bool core_dumps = false;
};

inline void add_program_options(CLI::App& app, ProgramOptions& options, const std::string& version) {
  app.set_version_flag("--version", version);
  add_manual_options(app, version);
  app.add_option("--config", options.config, "Configuration file in protobuf text format")->type_name("FILE");
  app.add_option("--set", options.settings,
                 "Set a configuration field, e.g. --set loop.rate_hz=2000; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option("--profile", options.profile,
                 "Link profile to emulate (delay, jitter, loss): a name in deploy/links, or a .txtpb file")
      ->type_name("NAME");
  app.add_option("--seconds", options.seconds, "Exit after this time, s")
      ->check(number_above_zero())
      ->type_name("N");
  app.add_option("--log", options.log, "Write the log to this file instead of standard error")
      ->type_name("FILE");
  app.add_option("--site", options.site,
                 "Certificate folder, created if missing; default: $XDG_CONFIG_HOME/longreach")
      ->type_name("DIR");
  app.add_option("--record", options.record,
                 "Record the whole run to this file, which `longreach-lab replay` can replay")
      ->type_name("FILE.mcap");
  app.add_option("--recordings", options.recordings,
                 "Folder for recordings made with `longreach record start`; default: "
                 "$XDG_STATE_HOME/longreach/recordings")
      ->type_name("DIR");
  app.add_option("--record-max-mb", options.record_max_mb, "Maximum size of the --record file, MB")
      ->type_name("N")
      ->check(number_between(1.0, 1e6))
      ->capture_default_str();
  app.add_flag("--insecure", options.insecure,
               "Serve RPC unencrypted to every user of this machine; for simulated robots only");
  app.add_flag("--core-dumps", options.core_dumps,
               "Permit core dumps and debuggers, which can expose the session secret");
  app.add_flag("--check", options.check,
               "Check the configuration, print all effective values and where they come from, and exit");
}

/// Returns the site folder. Throws SiteError.
inline std::filesystem::path site_of(const ProgramOptions& options) {
  return options.site.empty() ? default_site() : std::filesystem::path(options.site);
}

/// Returns the credentials of `role`, and disables core dumps unless the options permit core dumps. Call this
/// before the program has a secret. Throws SiteError.
inline RpcSecurity security_of(const ProgramOptions& options, RpcRole role) {
  if (!options.core_dumps) forbid_core_dumps();
  if (options.insecure) {
    put(STDERR_FILENO,
        "INSECURE: RPC is neither encrypted nor authenticated; every user of this machine can take control of "
        "the robot\n");
    return {};
  }
  RpcSecurity security{site_credentials(site_of(options), role)};
  refuse_revoked(site_of(options));
  return security;
}

/// Returns what the options ask for.
inline Asked asked(const ProgramOptions& options) {
  return {options.config, options.profile, options.settings};
}

/// Lists the files as "FIELD=PATH", each between `before` and `behind`.
inline std::string files_text(const std::vector<FileRead>& read, const std::string& before,
                              const std::string& behind) {
  std::string text;
  for (const FileRead& file : read) text += before + file.field + "=" + file.path.string() + behind;
  return text;
}

/// Parses the options and calls `run`. Converts exceptions to one sentence on standard error and an exit
/// status.
template <class Run>
int guarded_main(CLI::App& app, int argc, char** argv, const Run& run) {
  const auto complain = [&app](const std::exception& e, int status) {
    close_log();
    put(STDERR_FILENO, app.get_name() + ": " + e.what() + "\n");
    return status;
  };
  bound_standard_error();
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "%s: %s; --help shows the options\n", app.get_name().c_str(), e.what());
    return kExitBadUsage;
  }
  try {
    return run();
  } catch (const ConfigError& e) {
    return complain(e, kExitBadUsage);
  } catch (const AddressError& e) {
    return complain(e, kExitBadUsage);
  } catch (const RecordingError& e) {
    return complain(e, kExitBadUsage);
  } catch (const NoSiteError& e) {
    return complain(e, kExitBadUsage);
  } catch (const std::exception& e) {
    return complain(e, kExitFailed);
  }
}

}  // namespace longreach
