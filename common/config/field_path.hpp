#pragma once
// Places in a message: a path of fields from the root, and its text form "scene.material.wall.exponent". An
// element of a repeated message is addressed by its `name` or by its index from 0.

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

/// What a text path leads to. `error` empty: all of it; else `path` is the part that was found, and `error`
/// one sentence that says what is wrong and what would be possible.
struct PathLookup {
  FieldPath path;
  std::string error;
};

PathLookup find_path(const google::protobuf::Message& root, std::string_view text);

/// Text form; elements by name where they have one that leads back to them.
std::string path_text(const google::protobuf::Message& root, const FieldPath& path);

Names field_names(const google::protobuf::Descriptor& type);
Names enum_names(const google::protobuf::EnumDescriptor& type);

/// True for a field that holds messages.
bool holds_messages(const google::protobuf::FieldDescriptor& field);

/// The sub-message (or element) at one step; the default instance where it is not set.
const google::protobuf::Message& message_at(const google::protobuf::Message& parent, const PathStep& step);
google::protobuf::Message& mutable_message_at(google::protobuf::Message& parent, const PathStep& step);

/// The message that holds the last step of a path.
const google::protobuf::Message& holder(const google::protobuf::Message& root, const FieldPath& path);

/// `name` of a message that has such a field; else empty.
std::string name_of(const google::protobuf::Message& message);

}  // namespace longreach
