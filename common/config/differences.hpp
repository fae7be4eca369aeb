#pragma once
// Finds the fields with different effective values in two messages of one type. An unset field has its
// default value.

#include <google/protobuf/message.h>

#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

struct Difference {
  FieldPath path;  // a field that contains no messages, or a list that has a different length
  /// Strictest option of the field and the messages that contain it.
  proto::Change change = proto::NOT_WHILE_ENGAGED;
};

std::vector<Difference> differences(const google::protobuf::Message& before,
                                    const google::protobuf::Message& after);

}  // namespace longreach
