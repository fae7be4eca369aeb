#pragma once
// Loading, validating and addressing configuration, with one reflection-based validator for all messages
// (proto/config.proto). Errors name file, line and column, or the path of the field; the value; and what is
// allowed.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "master/config/master_config.hpp"
#include "proto/config.pb.h"
#include "slave/config/slave_config.hpp"

namespace longreach {

/// One sentence that names file and line or field, the value, the problem, and what is allowed. Control
/// characters of quoted text are escaped.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& sentence);
};

/// Parses a protobuf text file into `message` and validates it. Throws ConfigError "FILE:LINE:COLUMN: ..."
/// (from 1; a tab advances to the next multiple of 8; no position for a file that cannot be read), and then
/// `message` is unchanged.
void load_text_file(const std::filesystem::path& file, google::protobuf::Message& message);

/// The same for a text in memory; errors use `name` for it.
void load_text(const std::string& name, const std::string& text, google::protobuf::Message& message);

/// Checks every field that is set: range, finiteness, count, known enum value, known field. Then checks
/// fields that must be consistent: joint limits and start in order, release below touch, dead zone below
/// radius, names of materials and surfaces, directions that are not zero. Throws ConfigError with the path of
/// the field.
void validate(const google::protobuf::Message& message);

/// Sets one field from text, e.g. "estimator.forgetting" "0.995". An element of a repeated message is
/// addressed by index or by its `name` ("scene.material.wall.exponent"), a repeated number by a
/// comma-separated list (empty: not set). Times in seconds accept the units s, ms and us, fractions %; enums
/// are given by name in any case; flags as true, false, 1, 0, on, off. Throws ConfigError, and then `message`
/// is unchanged. It checks each field alone, since several may have to change together; call validate() after
/// the last one.
void set_field(google::protobuf::Message& message, std::string_view path, std::string_view value);

/// Returns a field or sub-message as text; the whole message for an empty path. Fields that are not set print
/// their default. set_field accepts the text of a field, load_text_file that of a message. Throws ConfigError
/// for an unknown path. With `start`, the configuration at the start of the side, comments state what clients
/// may set a field to.
std::string get_field(const google::protobuf::Message& message, std::string_view path,
                      const google::protobuf::Message* start = nullptr);

/// Sets "path=value" for a laboratory run like set_field, but `master.` or `slave.` may be omitted if only
/// one of them (or the LabConfig itself) has the path. loop.rate_hz and accuracy must agree and are set on
/// both sides. Throws ConfigError; for any other ambiguous path it names both.
void set_lab_field(proto::LabConfig& config, std::string_view setting);

/// Returns the full paths of the fields that set_lab_field sets for `path`: one or both sides; `path` itself
/// if it is unknown.
std::vector<std::string> lab_fields(const std::string& path);

/// Returns the paths of the fields whose effective values differ between two messages of one type and that
/// may not change while `engaged` (or, for AT_START fields and their content, while the program runs).
std::vector<std::string> refused_changes(const google::protobuf::Message& before,
                                         const google::protobuf::Message& after, bool engaged);

/// Returns the deploy folder: $LONGREACH_HOME, else the nearest `deploy` beside or above the program, else
/// above the working folder. Throws ConfigError with a remedy.
std::filesystem::path find_deploy_folder();

/// Reads the files in robots/ and scenes/ that a slave configuration names into its `robot` and `scene`. An
/// inline robot with joints is used as it is; the fields of one without joints override those of its file. An
/// inline scene is used as it is (an empty one is free space). Then sets the fields that `accuracy` controls,
/// and validates everything, including the number of joints (six). Throws ConfigError, and then `config` is
/// unchanged.
void resolve_files(proto::SlaveConfig& config, const std::filesystem::path& deploy_folder);

/// Reads the file in devices/ that a master configuration names; fields of its `device` override it; an empty
/// name reads none. Then sets the fields that `accuracy` controls, and validates everything. Throws
/// ConfigError, and then `config` is unchanged.
void resolve_files(proto::MasterConfig& config, const std::filesystem::path& deploy_folder);

/// Loads deploy/links/NAME.txtpb; its `name` is used if the file gives none. Throws ConfigError that lists
/// the known names.
proto::LinkProfile load_link_profile(const std::filesystem::path& deploy_folder, const std::string& name);

// Conversion of validated messages to plain structs and back. A test checks that no field is missing.
MasterConfig to_struct(const proto::MasterConfig& message);
SlaveConfig to_struct(const proto::SlaveConfig& message);
ImpairmentConfig to_struct(const proto::Impairment& message);
proto::MasterConfig to_message(const MasterConfig& config);
proto::SlaveConfig to_message(const SlaveConfig& config);
proto::Impairment to_message(const ImpairmentConfig& config);

}  // namespace longreach
