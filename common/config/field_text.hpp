#pragma once
// Conversion of the value of one field to text and back. Printed text is accepted and gives the same value.

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns the value of a field that contains no messages; the default if it is not set. Strings are
/// unquoted, a list is separated by ", ".
std::string value_text(const google::protobuf::Message& message, const PathStep& step);

/// Sets such a field from text. Throws ConfigError that begins with `path`; does not check ranges.
void set_value(google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field,
               std::string_view text, const std::string& path);

}  // namespace longreach
