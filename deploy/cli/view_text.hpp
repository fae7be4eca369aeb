#pragma once
// All values of the view of a side, as the schema names them. A new value needs no line here.

#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace longreach {

struct NamedValue {
  std::string name;   // with the names of the messages that contain it: "far.estimate.k"
  std::string value;  // six digits, without the unit, which the name contains; of a vector its numbers
};

/// Returns the values of a message and of those in it, in the order of the schema; absent ones are left out.
std::vector<NamedValue> values_of(const google::protobuf::Message& message);

/// Returns one line for each value.
std::string values_table(const google::protobuf::Message& message);

}  // namespace longreach
