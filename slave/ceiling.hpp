#pragma once
// What the slave was started with is the ceiling of its limits: from afar they can only be tightened.

#include <optional>
#include <string_view>

#include "slave/slave_config.hpp"

namespace longreach {

/// Path of a limit that `after` would loosen beyond `start`, or none. (The joints' limits are the robot's:
/// they do not change while the program runs.)
std::optional<std::string_view> loosened(const SlaveConfig& start, const SlaveConfig& after);

}  // namespace longreach
