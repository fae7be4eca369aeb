#pragma once
// The limits with which a side starts are upper bounds: clients can only tighten them, and can change only
// the fields that the schema permits (proto/options.proto, Remote). The same check is used for all fields of
// both sides.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns none if clients may change the configuration from `start` to `after`. Otherwise returns a sentence
/// with the first field that may not be changed in this way, its bound, and a remedy.
std::optional<std::string> beyond_ceiling(const google::protobuf::Message& start,
                                          const google::protobuf::Message& after);

/// Describes the values to which clients may set a field of `start`, such as "20 or less"; empty if clients
/// may not change the field.
std::string room_below_ceiling(const google::protobuf::Message& start, const PathStep& step);

}  // namespace longreach
