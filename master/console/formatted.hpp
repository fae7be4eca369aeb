#pragma once
// printf into a string. The result is truncated to 255 characters.

#include <array>
#include <cstdio>
#include <string>

namespace longreach {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

}  // namespace longreach
