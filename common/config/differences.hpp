#pragma once
// Effective differences of two messages of one type: a field that is not set counts as its default.

#include <google/protobuf/message.h>

#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

struct Difference {
  FieldPath path;  // a field that contains no messages, or a list with a different length
  proto::Change change = proto::NOT_WHILE_ENGAGED;  // strictest option of the field and its parents
};

std::vector<Difference> differences(const google::protobuf::Message& before,
                                    const google::protobuf::Message& after);

}  // namespace longreach
