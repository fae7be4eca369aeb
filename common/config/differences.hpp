#pragma once
// Finds the fields whose effective values differ between two messages of the same type. An unset field has
// its default value.

#include <google/protobuf/message.h>

#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

struct Difference {
  FieldPath path;  // a field that contains no messages, or a list that has a different length
  /// The strictest `change` option of the field and of the messages that contain it.
  proto::Change change = proto::NOT_WHILE_ENGAGED;
};

std::vector<Difference> differences(const google::protobuf::Message& before,
                                    const google::protobuf::Message& after);

}  // namespace longreach
