#pragma once
// Errors in a message and their positions. Two checks find them without access to files, so that a text file
// can add the line, and a setting the path of the field.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

struct Violation {
  FieldPath path;    // from the root of the checked message to the invalid field or element
  std::string text;  // continues the text of the path: " = 7 is outside 0.05 to 1"
};

/// Finds the first field that violates its own options: range, finiteness, count, unknown enum value, unknown
/// field number. One reflection walk visits the fields that are set.
std::optional<Violation> find_violation(const google::protobuf::Message& message);

/// Finds the first fields that are valid by themselves but not together: order of limits, references by name,
/// directions of zero length. Defaults are included. Absent parts (a robot without joints) are skipped.
std::optional<Violation> find_inconsistency(const google::protobuf::Message& message);

/// Applies the two checks above, in this order.
std::optional<Violation> find_any_violation(const google::protobuf::Message& message);

/// Returns "PATH TEXT" as one sentence.
std::string sentence(const google::protobuf::Message& root, const Violation& violation);

}  // namespace longreach
