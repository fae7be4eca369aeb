#pragma once
// JSON of the client's answers, one object per line. Names are those of the protobuf fields. Fields that are
// not set are included with their defaults, so that the set of keys is stable; 64-bit counts are strings, as
// in all protobuf JSON.

#include <string>
#include <string_view>

#include "deploy/cli/status_text.hpp"

namespace longreach {

/// A JSON string with its quotes. Bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);
std::string json_object(const google::protobuf::Message& message);

/// {"master": {...}, "slave": {...}}; null for a side that is down, and then "error" with the reason.
std::string status_json(const BothReports& reports);

}  // namespace longreach
