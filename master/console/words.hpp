#pragma once
// The states, causes and clamps of the system as an operator would say them. Pure; no trailing stops.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/console/snapshot.hpp"

namespace longreach {

std::string_view state_in_words(SafetyState state);
/// The cause of the state, where it is the slave's, and whether that is over; empty for none.
std::string cause_in_words(const MasterView& view);
/// Why the engagement that was asked for is not granted, and what to do.
std::string refusal_in_words(const MasterView& view);
std::string_view mode_in_words(MotionMode mode);

/// What is being clamped on either side now, and why; empty when nothing is.
std::vector<std::string> clamps_in_words(const MasterView& view);

/// How long ago that was which is known of the robot; none where the way is not known.
std::optional<double> age_of_news_s(const ConsoleSnapshot& snapshot);

/// One sentence: what is happening, and what the operator can do about it. What it says of the robot was true
/// one delay ago, and it says so where that is more than a tenth of a second.
std::string happening(const ConsoleSnapshot& snapshot);

}  // namespace longreach
