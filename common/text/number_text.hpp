#pragma once
// Converts numbers to text and back, exactly and strictly: printed text parses back to the same bits, and
// only a complete, finite decimal number is accepted (std::from_chars: no locale, hexadecimal notation,
// spaces or "+" sign).

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace longreach {

/// Returns the shortest text that parses back to `value`: 0.05, 20000, 1e-10, 1e12, nan, inf.
std::string format_number(double value);

/// Returns none for "nan", "inf", "1e999", "0x10", trailing text or empty text.
std::optional<double> parse_number(std::string_view text);

/// Like parse_number, but accept a unit: s, ms or us for seconds, % for fractions. The unit is applied to the
/// decimal text, so that "0.1ms" gives the double nearest to 0.0001.
std::optional<double> parse_seconds(std::string_view text);
std::optional<double> parse_fraction(std::string_view text);

template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace longreach
