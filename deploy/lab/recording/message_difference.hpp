#pragma once
// Finds the first bitwise difference between two messages of the same type, in the order of the schema.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace longreach {

struct MessageDifference {
  std::string field;  // path of the field, e.g. "wrench.force_n.x"
  std::string a, b;   // values as text; "absent" for a missing message
};
/// Returns std::nullopt if the messages are equal. Repeated fields are not supported, because recorded
/// outputs have none.
std::optional<MessageDifference> first_difference(const google::protobuf::Message& a,
                                                  const google::protobuf::Message& b);

}  // namespace longreach
