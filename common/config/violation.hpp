#pragma once
// Finds errors in a message and the fields that contain them. The functions do not access files: the caller
// adds the line of a text file, or the path of the field in a setting.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

struct Violation {
  FieldPath path;    // from the root of the checked message to the invalid field or element
  std::string text;  // follows the path in the error message, e.g. " = 7 is outside 0.05 to 1"
};

/// Finds the first field that violates its own options (range, finiteness, number of elements) or that has an
/// unknown enum value or field number. Visits only the fields that are set.
std::optional<Violation> find_violation(const google::protobuf::Message& message);

/// Finds the first fields that are valid individually but inconsistent with each other: order of limits,
/// references by name, directions of zero length. Unset fields are checked with their default values. Missing
/// parts, such as the joints of a robot, are not checked.
std::optional<Violation> find_inconsistency(const google::protobuf::Message& message);

/// Applies the two checks above, in this order.
std::optional<Violation> find_any_violation(const google::protobuf::Message& message);

/// Returns "PATH TEXT" as one sentence.
std::string sentence(const google::protobuf::Message& root, const Violation& violation);

}  // namespace longreach
