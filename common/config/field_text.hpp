#pragma once
// Converts the value of one field to text and back. Parsing the printed text gives the same value again.

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns the value of a field that contains no messages, or the default if it is not set. Strings are not
/// quoted; list elements are separated by ", ".
std::string value_text(const google::protobuf::Message& message, const PathStep& step);

/// Sets a field that contains no messages. Does not check ranges. Throws ConfigError with a message that
/// starts with `path`.
void set_value(google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field,
               std::string_view text, const std::string& path);

}  // namespace longreach
