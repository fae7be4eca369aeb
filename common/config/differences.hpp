#pragma once
// Where two messages of one type differ in effect: a field that is not set counts as its default.

#include <google/protobuf/message.h>

#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

struct Difference {
  FieldPath path;  // a field that holds no messages, or a list of another length
  proto::Change change = proto::NOT_WHILE_ENGAGED;  // strictest of the field and of what it is a part of
};

std::vector<Difference> differences(const google::protobuf::Message& before,
                                    const google::protobuf::Message& after);

}  // namespace longreach
