#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace longreach {

/// Returns the length of the well-formed UTF-8 character at the start of `text` (RFC 3629), or 0 if there is
/// none.
std::size_t utf8_length(std::string_view text);
bool is_utf8(std::string_view text);
/// Returns whether a text begins with a byte order mark of UTF-16.
bool is_utf16(std::string_view text);

/// Returns `text` in printable form: control characters and invalid UTF-8 are replaced by escapes such as
/// \x1b.
std::string printable(std::string_view text);

}  // namespace longreach
