#pragma once
// What is wrong with a message, and where: found by two checks that do not know files, so that a text file
// can add the line, and a setting the field's path.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

struct Violation {
  FieldPath path;    // from the root of the checked message; the field or element that is at fault
  std::string text;  // continues the path's text: " = 7 is outside 0.05 to 1"
};

/// First field that breaks its own options: range, finiteness, count, unknown enum value, unknown field
/// number. One reflection walk over the fields that are set.
std::optional<Violation> find_violation(const google::protobuf::Message& message);

/// First fields that are fine each by itself but not together: limits in order, names that refer to
/// something, directions that are not zero. Defaults count. Absent parts (a robot without joints) are not
/// looked for.
std::optional<Violation> find_inconsistency(const google::protobuf::Message& message);

/// The two above, in this order.
std::optional<Violation> find_any_violation(const google::protobuf::Message& message);

/// "PATH TEXT" as one sentence.
std::string sentence(const google::protobuf::Message& root, const Violation& violation);

}  // namespace longreach
