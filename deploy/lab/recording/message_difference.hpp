#pragma once
// The first difference of two messages of one type, bit for bit, in the order of the schema.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace longreach {

struct MessageDifference {
  std::string field;  // path, e.g. "wrench.force_n.x"
  std::string a, b;   // values as text; "absent" for a missing message
};
/// Returns none if they are equal. Repeated fields are not handled, because recorded outputs have none.
std::optional<MessageDifference> first_difference(const google::protobuf::Message& a,
                                                  const google::protobuf::Message& b);

}  // namespace longreach
