#pragma once
// Colours for rows of the status table: dim labels, states in green, yellow or red. Pure.

#include <string>
#include <string_view>

namespace longreach {

/// Returns `row` without its newline, with ANSI colours and unchanged width.
std::string painted(std::string_view row);

}  // namespace longreach
