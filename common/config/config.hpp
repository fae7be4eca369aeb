#pragma once
// Loads and validates configurations, and accesses their fields by path. One reflection-based validator
// handles all messages (proto/config_*.proto). An error states the position (file, line and column, or the path
// of the field), the value, and what is allowed.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "proto/config.pb.h"
#include "schema/config_master.hpp"
#include "schema/config_slave.hpp"

namespace longreach {

/// Describes an invalid configuration in one sentence: the position (file and line, or field), the value, the
/// problem, and what is allowed. Control characters in quoted text are escaped.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& sentence);
};

/// Parses a protobuf text file into `message` and validates it. On error, throws ConfigError
/// "FILE:LINE:COLUMN: ..." and leaves `message` unchanged. Lines and columns count from 1, and a tab advances
/// to the next multiple of 8; the position is omitted if the file cannot be read.
void load_text_file(const std::filesystem::path& file, google::protobuf::Message& message);

/// Parses and validates text in memory in the same way; errors refer to it as `name`.
void load_text(const std::string& name, const std::string& text, google::protobuf::Message& message);

/// Checks every field that is set: range, finiteness, number of elements, known enum value, known field. Then
/// checks that the fields are consistent; for example, start positions must be within the joint limits, and
/// the release threshold must be below the touch threshold. Throws ConfigError with the path of the field.
void validate(const google::protobuf::Message& message);

/// Sets one field from text, e.g. "estimator.forgetting" to "0.995". An element of a repeated message is
/// addressed by its index or its `name` ("scene.material.wall.exponent"). A repeated number is set from a
/// comma-separated list; an empty list clears the field. Times accept the units s, ms and us, and fractions
/// accept %. Enums are given by name in upper or lower case, and flags as true, false, 1, 0, on or off. On
/// error, throws ConfigError and leaves `message` unchanged. Checks only this field, because several fields
/// may have to change together: call validate() after the last one.
void set_field(google::protobuf::Message& message, std::string_view path, std::string_view value);

/// Returns a field or sub-message as text, or the whole message if the path is empty. Unset fields are
/// printed with their defaults. The text of a field can be passed to set_field, and the text of a message to
/// load_text. Throws ConfigError if the path is unknown. If `start`, the configuration with which the side
/// started, is given, comments in the text state which values clients may set.
std::string get_field(const google::protobuf::Message& message, std::string_view path,
                      const google::protobuf::Message* start = nullptr);

/// Applies a setting "path=value" to the configuration of a laboratory run, as set_field does for one side.
/// The prefix `master.` or `slave.` may be omitted if only one side (or the LabConfig itself) has the path.
/// loop.rate_hz and accuracy must agree, so they are set on both sides. Throws ConfigError; for any other
/// ambiguous path, the error lists both alternatives.
void set_lab_field(proto::LabConfig& config, std::string_view setting);

/// Returns the full paths of the fields that set_lab_field sets for `path`, on one or both sides. Returns
/// `path` itself if it is unknown.
std::vector<std::string> lab_fields(const std::string& path);

/// Returns the paths of the fields that differ between two messages of the same type although they may not be
/// changed now: AT_START fields and everything inside them, and, while `engaged`, NOT_WHILE_ENGAGED fields.
/// Unset fields have their default values.
std::vector<std::string> refused_changes(const google::protobuf::Message& before,
                                         const google::protobuf::Message& after, bool engaged);

/// Returns the deploy folder: $LONGREACH_HOME if it is set, otherwise the nearest `deploy` folder next to or
/// above the program, otherwise the nearest one above the working folder. Throws ConfigError with a remedy.
std::filesystem::path find_deploy_folder();

/// Reads the robot and scene files that a slave configuration names (in robots/ and scenes/) into its `robot`
/// and `scene`. An inline robot with joints replaces the file; an inline robot without joints only overrides
/// the fields that it sets. An inline scene replaces the file (an empty scene is free space). Then sets the
/// fields that `accuracy` controls and validates everything, including the number of joints (six). On error,
/// throws ConfigError and leaves `config` unchanged.
void resolve_files(proto::SlaveConfig& config, const std::filesystem::path& deploy_folder);

/// Reads the device file that a master configuration names (in devices/), unless the name is empty. The
/// fields of an inline `device` override those of the file. Then sets the fields that `accuracy` controls and
/// validates everything. On error, throws ConfigError and leaves `config` unchanged.
void resolve_files(proto::MasterConfig& config, const std::filesystem::path& deploy_folder);

/// Loads deploy/links/NAME.txtpb. The profile is named NAME unless the file sets `name`. Throws a ConfigError
/// that lists the known names.
proto::LinkProfile load_link_profile(const std::filesystem::path& deploy_folder, const std::string& name);

// Convert validated messages to plain structs and back.
MasterConfig to_struct(const proto::MasterConfig& message);
SlaveConfig to_struct(const proto::SlaveConfig& message);
ImpairmentConfig to_struct(const proto::Impairment& message);
proto::MasterConfig to_message(const MasterConfig& config);
proto::SlaveConfig to_message(const SlaveConfig& config);
proto::Impairment to_message(const ImpairmentConfig& config);

}  // namespace longreach
