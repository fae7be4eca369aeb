#pragma once
// The gripper's state as an operator would say it. Pure; no trailing stops.

#include <string>

#include "common/link/telemetry.hpp"

namespace longreach {

/// Open, closed, holds something, holds so many kg.
std::string in_words(const GripperState& gripper);

}  // namespace longreach
