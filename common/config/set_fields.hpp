#pragma once
// Several fields set together, by path and text as set_field (config.hpp) takes them.

#include <google/protobuf/message.h>

#include <string>
#include <utility>
#include <vector>

namespace longreach {

/// Sets the fields in their order, all of them or none, and validates the whole once. Throws ConfigError, and
/// then `message` is unchanged.
void set_fields(google::protobuf::Message& message,
                const std::vector<std::pair<std::string, std::string>>& assignments);

}  // namespace longreach
