#pragma once
// Lines and columns of a text file, counted from 0 as in protobuf's tokenizer: each byte is a column, and a
// tab advances to the next multiple of 8.

#include <cstddef>
#include <string_view>

namespace longreach {

struct TextPosition {
  int line = 0;
  int column = 0;
};

std::size_t offset_of(std::string_view text, TextPosition position);
TextPosition position_of(std::string_view text, std::size_t offset);

/// Returns the start of the last `word` before `position`, because the parser reports some errors at a
/// position after the word that causes them.
TextPosition last_before(std::string_view text, std::string_view word, TextPosition position);

}  // namespace longreach
