#pragma once
// Colours for the rows of the status table: dim labels, and states in green, yellow or red. Pure function.

#include <string>
#include <string_view>

namespace longreach {

/// Returns `row` (passed without its newline) with ANSI colours. Its visible width does not change.
std::string painted(std::string_view row);

}  // namespace longreach
