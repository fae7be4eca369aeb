#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace longreach {

/// Length of the well-formed UTF-8 character at the front (RFC 3629); 0 if there is none.
std::size_t utf8_length(std::string_view text);
bool is_utf8(std::string_view text);

/// `text` for a person to read: control characters, and what is not UTF-8, as \x1b.
std::string printable(std::string_view text);

}  // namespace longreach
