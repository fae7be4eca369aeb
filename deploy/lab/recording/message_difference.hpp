#pragma once
// Where two messages of one type differ first, bit for bit, in the order of the schema.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace longreach {

struct MessageDifference {
  std::string field;  // path, e.g. "wrench.force_n.x"
  std::string a, b;   // values as text; "absent" for a message that is not there
};
/// None: they are the same. Does not handle repeated fields, which recorded outputs have none of.
std::optional<MessageDifference> first_difference(const google::protobuf::Message& a,
                                                  const google::protobuf::Message& b);

}  // namespace longreach
