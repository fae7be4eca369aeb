#pragma once
// Records where the effective value of each field of a configuration comes from: the default, the preset, a file
// that a setting names (robot, device, scene, link profile), the configuration file, the command line or a client.

#include <google/protobuf/message.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

inline constexpr std::string_view kFromCommandLine = "command line";
inline constexpr std::string_view kFromConfigFile = "configuration file";  // the file follows after a space

/// Returns the paths of all fields that contain values and are set in `message`, with elements by index, such as
/// "robot.joint.0.a_m".
std::vector<std::string> set_paths(const google::protobuf::Message& message);

/// Returns the text form of a path in which elements are addressed by index.
std::string path_by_index(const FieldPath& path);

class Origins {
 public:
  /// Records `origin` for every field that is set in `message` and has no origin yet.
  void add(const google::protobuf::Message& message, const std::string& origin);
  /// Records `origin` for the field `path` (or every field in it that is set in `message`) in place of the present
  /// one. Elements may be given by name. An unknown path is ignored.
  void replace(const google::protobuf::Message& message, std::string_view path, const std::string& origin);
  /// Discards what is recorded for `path` and everything in it.
  void forget(std::string_view path);

  /// Returns the origin of a field; elements by index. "default" if none is recorded.
  [[nodiscard]] const std::string& of(const std::string& path) const;
  /// Returns whether a person set the field or anything in it: on the command line or in the configuration file.
  [[nodiscard]] bool set_by_person(std::string_view path) const;
  /// Returns the fields that a person set on the command line or in the configuration file.
  [[nodiscard]] std::vector<std::string> set_by_person() const;

 private:
  std::map<std::string, std::string, std::less<>> by_path_;
};

/// Returns `origins` in which the fields that differ between `start` and `present` come from a client.
Origins with_clients(Origins origins, const google::protobuf::Message& start,
                     const google::protobuf::Message& present);

/// Returns the same text as get_field (config.hpp), in which a comment behind each value names its origin.
std::string get_field_with_origins(const google::protobuf::Message& message, std::string_view path,
                                   const google::protobuf::Message* start, const Origins& origins);

}  // namespace longreach
