#pragma once
// Positions in a message: a path of fields from the root, and its text form "scene.material.wall.exponent".
// An element of a repeated message is addressed by its `name` or by its index from 0.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <string_view>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "proto/options.pb.h"

namespace longreach {

struct PathStep {
  const google::protobuf::FieldDescriptor* field = nullptr;
  int index = -1;  // element of a repeated field; -1: the field as a whole
};
using FieldPath = std::vector<PathStep>;

/// Result of resolving a text path. If `error` is empty, the whole path was resolved; otherwise `path` is the
/// resolved part, and `error` is one sentence with the problem and the alternatives.
struct PathLookup {
  FieldPath path;
  std::string error;
};

PathLookup find_path(const google::protobuf::Message& root, std::string_view text);

/// Returns the text form; elements are addressed by name if the name is unique.
std::string path_text(const google::protobuf::Message& root, const FieldPath& path);

Names field_names(const google::protobuf::Descriptor& type);
Names enum_names(const google::protobuf::EnumDescriptor& type);

/// Returns true for a field that contains messages.
bool holds_messages(const google::protobuf::FieldDescriptor& field);

/// Returns the sub-message (or element) at one step; the default instance if it is not set.
const google::protobuf::Message& message_at(const google::protobuf::Message& parent, const PathStep& step);
google::protobuf::Message& mutable_message_at(google::protobuf::Message& parent, const PathStep& step);

/// Returns the message that contains the last step of a path.
const google::protobuf::Message& holder(const google::protobuf::Message& root, const FieldPath& path);

/// Returns the `name` of a message with such a field; otherwise empty.
std::string name_of(const google::protobuf::Message& message);

}  // namespace longreach
