#pragma once
// The limits at the start of a side are upper bounds: clients can only tighten them, and can change only what
// the schema permits (proto/options.proto, Remote). One check covers every field of both sides; plan_change
// makes `set` atomic.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns why clients may not change the configuration from `start` to `after`, or none: one sentence with
/// the first such field, its bound, and a remedy.
std::optional<std::string> beyond_ceiling(const google::protobuf::Message& start,
                                          const google::protobuf::Message& after);

/// Returns what clients may set a field of `start` to, "20 or less"; empty: no other value.
std::string room_below_ceiling(const google::protobuf::Message& start, const PathStep& step);

}  // namespace longreach
