#include "common/text/text_position.hpp"

namespace longreach {
namespace {

constexpr int kTabWidth = 8;  // google::protobuf::io::Tokenizer

TextPosition after(TextPosition position, char c) {
  if (c == '\n') return {position.line + 1, 0};
  if (c == '\t') return {position.line, position.column + kTabWidth - position.column % kTabWidth};
  return {position.line, position.column + 1};
}

}  // namespace

std::size_t offset_of(std::string_view text, TextPosition wanted) {
  TextPosition position;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool reached =
        position.line > wanted.line || (position.line == wanted.line && position.column >= wanted.column);
    if (reached) return i;
    position = after(position, text[i]);
  }
  return text.size();
}

TextPosition position_of(std::string_view text, std::size_t offset) {
  TextPosition position;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) position = after(position, text[i]);
  return position;
}

TextPosition last_before(std::string_view text, std::string_view word, TextPosition position) {
  const std::size_t end = offset_of(text, position);
  if (word.empty() || end < word.size()) return position;
  const auto start = text.rfind(word, end - word.size());
  return start == std::string_view::npos ? position : position_of(text, start);
}

}  // namespace longreach
