#pragma once
// Sets several fields together, by path and text as in set_field (config.hpp).

#include <google/protobuf/message.h>

#include <string>
#include <utility>
#include <vector>

namespace longreach {

/// Sets the fields in order, either all or none, and validates the result once. Throws ConfigError, and then
/// `message` is unchanged.
void set_fields(google::protobuf::Message& message,
                const std::vector<std::pair<std::string, std::string>>& assignments);

}  // namespace longreach
