#pragma once
// The client's output as JSON, one object per line. The keys are the names of the protobuf fields. Unset
// fields are included with their defaults, so that the set of keys is stable. 64-bit integers are strings, as
// in all protobuf JSON.

#include <string>
#include <string_view>

#include "deploy/cli/status_text.hpp"

namespace longreach {

/// Returns `text` as a JSON string with its quotes. Bytes that are not valid UTF-8 become U+FFFD.
std::string json_string(std::string_view text);
std::string json_object(const google::protobuf::Message& message);

/// Returns {"master": {...}, "slave": {...}}. A side that is down is null, and "error" gives the reason.
std::string status_json(const BothReports& reports);

}  // namespace longreach
