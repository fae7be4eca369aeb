#pragma once
// The states, causes and clamps of the system as an operator would say them. Pure; no trailing stops.

#include <string>
#include <string_view>
#include <vector>

#include "master/console/snapshot.hpp"

namespace longreach {

std::string_view state_in_words(SafetyState state);
std::string_view cause_in_words(HoldCause cause);  // empty for kNone
std::string_view mode_in_words(MotionMode mode);

/// What is being clamped on either side now, and why; empty when nothing is.
std::vector<std::string> clamps_in_words(const MasterView& view);

/// One sentence: what is happening, and what the operator can do about it.
std::string happening(const ConsoleSnapshot& snapshot);

}  // namespace longreach
