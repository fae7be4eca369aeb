#pragma once
// The value of one field as text, and back. What is printed is accepted again and gives the same value.

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "common/config/field_path.hpp"

namespace longreach {

/// Value of a field that holds no messages; the default where it is not set. Strings as they are, a whole
/// list separated by ", ".
std::string value_text(const google::protobuf::Message& message, const PathStep& step);

/// Sets such a field from text. Throws ConfigError that begins with `path`; ranges are not checked here.
void set_value(google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field,
               std::string_view text, const std::string& path);

}  // namespace longreach
