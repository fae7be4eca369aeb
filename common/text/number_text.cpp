#include "common/text/number_text.hpp"

#include <array>
#include <cmath>

namespace longreach {
namespace {

// "1e-05" and "1e+12" as "1e-5" and "1e12".
std::string tidy_exponent(std::string_view text) {
  const auto e = text.find('e');
  if (e == std::string_view::npos) return std::string(text);
  std::string tidy(text.substr(0, e + 1));
  std::string_view exponent = text.substr(e + 1);
  if (exponent.starts_with('-')) tidy += '-';
  exponent.remove_prefix(1);
  while (exponent.size() > 1 && exponent.front() == '0') exponent.remove_prefix(1);
  return tidy.append(exponent);
}

std::optional<double> parse_scaled(std::string_view number, int exponent) {
  const auto value = parse_number(number);
  if (!value || exponent == 0) return value;
  if (number.find_first_of("eE") != std::string_view::npos) return *value / std::pow(10.0, -exponent);
  return parse_number(std::string(number) + "e" + std::to_string(exponent));
}

}  // namespace

std::string format_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  // Plain digits where they are easy to read; the shortest form alone would print 20000 as 2e+04.
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e7);
  std::array<char, 64> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          plain ? std::chars_format::fixed : std::chars_format::scientific);
  return tidy_exponent(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> parse_seconds(std::string_view text) {
  struct Unit {
    std::string_view name;
    int exponent;
  };
  constexpr std::array<Unit, 3> kUnits{{{"ms", -3}, {"us", -6}, {"s", 0}}};
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name)) continue;
    return parse_scaled(text.substr(0, text.size() - unit.name.size()), unit.exponent);
  }
  return parse_number(text);
}

std::optional<double> parse_fraction(std::string_view text) {
  if (!text.ends_with('%')) return parse_number(text);
  return parse_scaled(text.substr(0, text.size() - 1), -2);
}

}  // namespace longreach
