#pragma once
// Paths to the fields of a message: a sequence of fields from the root, and its text form, such as
// "scene.material.wall.exponent". An element of a repeated message is addressed by its `name` or by its
// index, which starts at 0.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <string_view>
#include <vector>

#include "common/text/nearest_name.hpp"
#include "proto/options.pb.h"

namespace longreach {

struct PathStep {
  const google::protobuf::FieldDescriptor* field = nullptr;
  int index = -1;  // element of a repeated field; -1: the field as a whole
};
using FieldPath = std::vector<PathStep>;

/// Result of resolving a path that is given as text. If `error` is empty, the whole path was resolved.
/// Otherwise `path` is the part that was resolved, and `error` describes the problem and the alternatives in
/// one sentence.
struct PathLookup {
  FieldPath path;
  std::string error;
};

PathLookup find_path(const google::protobuf::Message& root, std::string_view text);

/// Returns the text form of a path. Elements are addressed by name if the name is unique.
std::string path_text(const google::protobuf::Message& root, const FieldPath& path);

Names field_names(const google::protobuf::Descriptor& type);
Names enum_names(const google::protobuf::EnumDescriptor& type);

/// Returns whether a field contains messages, as opposed to values.
bool holds_messages(const google::protobuf::FieldDescriptor& field);

/// Returns the sub-message or element at one step, or the default instance if it is not set.
const google::protobuf::Message& message_at(const google::protobuf::Message& parent, const PathStep& step);
google::protobuf::Message& mutable_message_at(google::protobuf::Message& parent, const PathStep& step);

/// Returns the message that contains the field at the end of a path.
const google::protobuf::Message& holder(const google::protobuf::Message& root, const FieldPath& path);

/// Returns the field `name` of a message, or an empty string if its type does not have this field.
std::string name_of(const google::protobuf::Message& message);

}  // namespace longreach
