#pragma once
// States, causes and limits of the system as text for the operator. The functions are pure, and their texts
// have no trailing full stop.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/console/snapshot.hpp"

namespace longreach {

std::string_view state_in_words(SafetyState state);
/// Returns the cause of the state, including whether the slave reported it and whether it is over. Returns an
/// empty string if there is no cause.
std::string cause_in_words(const MasterView& view);
/// Returns why the requested engagement was not granted, and a remedy.
std::string refusal_in_words(const MasterView& view);
std::string_view mode_in_words(MotionMode mode);

/// Returns how far the goal has moved out of the touched surfaces during this contact; empty if less than 1 mm.
std::string moved_out_in_words(const MasterView& view);

/// Returns the active limits of both sides with their reasons; empty if there are none.
std::vector<std::string> clamps_in_words(const MasterView& view);

/// Returns the age of the data about the robot, s; none if the delay is unknown.
std::optional<double> age_of_news_s(const ConsoleSnapshot& snapshot);

}  // namespace longreach
