#pragma once
// What a side was started with is the ceiling of its limits: clients only tighten them, and change nothing
// that the schema does not leave to them (proto/options.proto, Remote). One check for every field of both
// sides; that `set` is applied whole or not at all is plan_change's.

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// Why clients may not bring the configuration from `start` to `after`, or none: one sentence with the first
/// such field, its ceiling, and what to do.
std::optional<std::string> beyond_ceiling(const google::protobuf::Message& start,
                                          const google::protobuf::Message& after);

/// What clients may set a field of `start` to, "20 or less"; empty: nothing else.
std::string room_below_ceiling(const google::protobuf::Message& start, const PathStep& step);

}  // namespace longreach
