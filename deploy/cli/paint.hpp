#pragma once
// Colour for rows of the status table: labels dim, states as in traffic. Pure.

#include <string>
#include <string_view>

namespace longreach {

/// `row` without its end, with ANSI colours; it is as wide as before.
std::string painted(std::string_view row);

}  // namespace longreach
