#pragma once
// Common parts of the fuzz targets. A target accepts arbitrary bytes and returns 0, or aborts if a rule is
// violated.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "common/config/config.hpp"

namespace longreach::fuzz {

inline void require(bool holds, const char* rule) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", rule);
  std::abort();
}

/// Requires that the message of an error begins with the name of the text, is a single line, and contains no
/// control characters.
inline void require_readable(const ConfigError& error, std::string_view name) {
  const std::string_view what = error.what();
  require(what.starts_with(name), "an error names its file");
  for (const char c : what)
    require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "an error is one line of text");
}

/// Returns the length of a record, which is stored in its first two bytes in little-endian order.
inline std::size_t length_of(std::span<const std::byte> bytes) {
  return std::to_integer<std::size_t>(bytes[0]) | std::to_integer<std::size_t>(bytes[1]) << 8;
}

/// Parses the text into `message`. If the text is rejected, requires that the error is readable, leaves
/// `message` unchanged and returns false.
template <class Message>
bool load(const std::string& text, Message& message) {
  try {
    load_text("text", text, message);
    return true;
  } catch (const ConfigError& error) {
    require_readable(error, "text");
    return false;
  }
}

}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
