#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace longreach {

/// Length of the well-formed UTF-8 character at the front (RFC 3629); 0 if there is none.
std::size_t utf8_length(std::string_view text);
bool is_utf8(std::string_view text);

/// Returns `text` in printable form: control characters and invalid UTF-8 become \x1b and the like.
std::string printable(std::string_view text);

}  // namespace longreach
