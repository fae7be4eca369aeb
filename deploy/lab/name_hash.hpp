#pragma once
// The 64-bit FNV-1a hash as 16 hexadecimal digits, used as a short identifier of long texts.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

inline std::string name_hash(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = kDigits[(hash >> (4 * i)) & 15];
  return text;
}

}  // namespace longreach
