#pragma once
// Sets several fields at once. Each is given by path and text, as for set_field (config.hpp).

#include <google/protobuf/message.h>

#include <string>
#include <utility>
#include <vector>

namespace longreach {

/// Sets the fields in order, either all of them or none, and validates the result once. On error, throws
/// ConfigError and leaves `message` unchanged.
void set_fields(google::protobuf::Message& message,
                const std::vector<std::pair<std::string, std::string>>& assignments);

}  // namespace longreach
