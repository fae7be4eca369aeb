#pragma once
// The limits with which a side starts are upper bounds: clients can only tighten them, and can change only
// the fields that the schema permits (proto/options.proto, Remote). One check covers every field of both
// sides; plan_change makes `set` atomic.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns none if clients may change the configuration from `start` to `after`. Otherwise returns one
/// sentence that names the first field that they may not change like this, its bound, and a remedy.
std::optional<std::string> beyond_ceiling(const google::protobuf::Message& start,
                                          const google::protobuf::Message& after);

/// Describes the values that clients may give a field of `start`, such as "20 or less"; empty if they may not
/// change it.
std::string room_below_ceiling(const google::protobuf::Message& start, const PathStep& step);

}  // namespace longreach
