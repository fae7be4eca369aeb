#pragma once
// Loading, validating and addressing configuration. One reflection-based validator for all messages.
// Messages: proto/config.proto. Errors name file, line and column, or the field's path; the value; what is
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

/// One sentence that says which file and line or field, which value, why not, and what is allowed. Control
/// characters of a quoted text are escaped.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& sentence);
};

/// Parses a protobuf text file into `message` and validates it. Throws ConfigError "FILE:LINE:COLUMN: ..."
/// (from 1; a tab advances to the next multiple of 8; no position for a file that cannot be read), and then
/// `message` is unchanged.
void load_text_file(const std::filesystem::path& file, google::protobuf::Message& message);

/// The same for a text that is at hand; errors call it `name`.
void load_text(const std::string& name, const std::string& text, google::protobuf::Message& message);

/// Checks every field that is set: range, finiteness, count, known enum value, known field; then the fields
/// that must agree with each other: joint limits and start in order, release below touch, dead zone below
/// radius, names of materials and surfaces, directions that are not zero. Throws ConfigError with the field's
/// path.
void validate(const google::protobuf::Message& message);

/// Sets one field from text, e.g. "estimator.forgetting" "0.995"; a repeated message is addressed by index or
/// by its `name` ("scene.material.wall.exponent"), a repeated number by a comma-separated list (empty: not
/// set). Times in seconds take the units s, ms and us, fractions %; enums by name, whatever the case; flags
/// true, false, 1, 0, on, off. Throws ConfigError, and then `message` is unchanged. Checks fields each by
/// itself: several may have to change together, so call validate() after the last.
void set_field(google::protobuf::Message& message, std::string_view path, std::string_view value);

/// A field or sub-message as text; the whole for an empty path. Fields that are not set print their default.
/// The text of a field is accepted by set_field, that of a message by load_text_file. Throws ConfigError for
/// an unknown path. `start`, of the same type: what its side was started with; a comment says then what
/// clients may set a field to.
std::string get_field(const google::protobuf::Message& message, std::string_view path,
                      const google::protobuf::Message* start = nullptr);

/// A setting "path=value" for a laboratory run: as set_field, but `master.` or `slave.` may be left out where
/// only one of them (or the LabConfig itself) has the path. What both sides have and must agree on,
/// loop.rate_hz and accuracy, sets both. Throws ConfigError; any other ambiguous path names both.
void set_lab_field(proto::LabConfig& config, std::string_view setting);

/// The whole paths of the fields that set_lab_field sets by `path`: both sides', or one; `path` itself when
/// it is unknown.
std::vector<std::string> lab_fields(const std::string& path);

/// Paths of the fields whose effective values differ between two messages of one type and that may not change
/// with `engaged` (or, for AT_START fields and all inside them, while the program runs).
std::vector<std::string> refused_changes(const google::protobuf::Message& before,
                                         const google::protobuf::Message& after, bool engaged);

/// deploy folder: $LONGREACH_HOME, else the nearest `deploy` beside or above the program, else above the
/// working directory. Throws ConfigError that says what to do.
std::filesystem::path find_deploy_folder();

/// Reads robots/ and scenes/ files that a slave configuration names into its `robot` and `scene`. A robot in
/// place that has joints is taken as it is, the fields of one without go over those of its file; a scene in
/// place is taken as it is (an empty one is free space). Then validates all, and that there are six joints.
/// What `accuracy` chooses is set where it is not. Throws ConfigError, and then `config` is unchanged.
void resolve_files(proto::SlaveConfig& config, const std::filesystem::path& deploy_folder);

/// Reads the devices/ file that a master configuration names under what its `device` says; none for an empty
/// name, and what `accuracy` chooses where it is not set. Then validates all. Throws ConfigError, and then
/// `config` is unchanged.
void resolve_files(proto::MasterConfig& config, const std::filesystem::path& deploy_folder);

/// deploy/links/NAME.txtpb; its `name` where the file gives none. Throws ConfigError that lists the known
/// names.
proto::LinkProfile load_link_profile(const std::filesystem::path& deploy_folder, const std::string& name);

// Plain structs from validated messages, and back. A test proves that no field is forgotten.
MasterConfig to_struct(const proto::MasterConfig& message);
SlaveConfig to_struct(const proto::SlaveConfig& message);
ImpairmentConfig to_struct(const proto::Impairment& message);
proto::MasterConfig to_message(const MasterConfig& config);
proto::SlaveConfig to_message(const SlaveConfig& config);
proto::Impairment to_message(const ImpairmentConfig& config);

}  // namespace longreach
