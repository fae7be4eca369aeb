#include <array>
#include <cstdio>

#include "common/config/config.hpp"

namespace longreach {
namespace {

// Texts of files and arguments come back in errors: none of them may break the line or steer a terminal.
std::string without_controls(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      out += c;
      continue;
    }
    std::array<char, 8> escape{};
    std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned char>(c));
    out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : escape.data();
  }
  return out;
}

}  // namespace

ConfigError::ConfigError(const std::string& sentence) : std::runtime_error(without_controls(sentence)) {}

}  // namespace longreach
