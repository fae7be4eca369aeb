#pragma once
// Determines the effective configuration of a side. Values are applied in one order, each over those before it:
// default, preset (accuracy), the files that a setting names (robot, device, scene), the configuration file, the
// link profile and the settings of the command line in their order. Clients change the result later. The programs,
// the laboratory, its sweeps and Python use these functions.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/config/file_search.hpp"
#include "common/config/origins.hpp"
#include "proto/config.pb.h"

namespace longreach {

/// A setting of the command line. `path` is relative to the side; `text` is the setting PATH=VALUE as it is written.
struct Setting {
  std::string path;
  std::string text;
};

/// A configuration to which settings are applied: the message of a side, or the part of a LabConfig.
template <class Side>
struct Target {
  std::function<Side&()> config;
  std::function<void(const std::string& text)> apply;  // throws ConfigError
  bool of_laboratory = false;                          // part of a LabConfig, which the caller validates
  /// Returns the robot of an MJCF file (robot.mjcf). Throws ConfigError. Null: the program cannot simulate such a robot,
  /// and robot.mjcf is rejected.
  std::function<proto::Robot(const std::string& file)> read_mjcf{};
};

/// What is recorded during an assembly, if it is not null.
struct AssemblyLog {
  std::vector<FileRead>* read = nullptr;
  Origins* origins = nullptr;  // contains the origins of what the target contains
  /// What a robot file contains and longreach ignores, and limits that are looser than those of the file.
  std::vector<std::string>* warnings = nullptr;
};

/// Applies the settings to the target, with the files that they or the target name, and validates the result, unless
/// it is part of a LabConfig, which has rules of its own. A robot with joints or a scene in the target replaces the
/// file, unless a setting names another file. On error, throws ConfigError; the target is then undefined.
void assemble(const Target<proto::SlaveConfig>& target, const std::vector<Setting>& settings,
              const FileSearch& search, const AssemblyLog& log);
void assemble(const Target<proto::MasterConfig>& target, const std::vector<Setting>& settings,
              const FileSearch& search, const AssemblyLog& log);

/// What a program is asked for.
struct Asked {
  std::string config;                 // configuration file; empty: none
  std::string profile;                // link profile; empty: none
  std::vector<std::string> settings;  // PATH=VALUE
};

template <class Side>
struct Effective {
  Side config;
  std::vector<FileRead> files;
  Origins origins;
  std::vector<std::string>
      warnings;  // one sentence for each setting that has no effect or is looser than a file
};

/// Returns the effective configuration of a program. Side: proto::MasterConfig or proto::SlaveConfig. Throws
/// ConfigError.
template <class Side>
Effective<Side> effective_config(const Asked& asked);

/// Returns the text of --check: the files, the notes, the warnings, and all effective values with their origins.
template <class Side>
std::string check_text(const Effective<Side>& effective, const std::string& notes);

/// Returns one sentence for each field that a person set and that the chosen robot, device, estimator or another
/// setting makes ineffective.
std::vector<std::string> ineffective_settings(const proto::SlaveConfig& config, const Origins& origins);
std::vector<std::string> ineffective_settings(const proto::MasterConfig& config, const Origins& origins);

}  // namespace longreach
