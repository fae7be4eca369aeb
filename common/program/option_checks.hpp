#pragma once
// Checks of command-line values, shared by all programs. Include this header only in files that use CLI11.

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <string>

#include "common/config/host_and_port.hpp"
#include "common/text/number_text.hpp"

namespace longreach {

/// Accepts decimal numbers from `low` to `high`. Rejects NaN, which passes CLI11's own range check.
inline CLI::Validator number_between(double low, double high) {
  return {[low, high](const std::string& text) {
            const auto number = parse_number(text);
            if (number && *number >= low && *number <= high) return std::string();
            return text + " is not a number from " + format_number(low) + " to " + format_number(high);
          },
          ""};
}

inline CLI::Validator number_above_zero() {
  return {[](const std::string& text) {
            const auto number = parse_number(text);
            return number && *number > 0.0 ? std::string() : text + " is not a number above 0";
          },
          ""};
}

/// Accepts 64-bit whole numbers; CLI11's own check also accepts -1 and numbers that are too large.
inline CLI::Validator whole_number() {
  return {[](const std::string& text) {
            return parse_integer<std::uint64_t>(text)
                       ? std::string()
                       : text + " is not a whole number from 0 to 18446744073709551615";
          },
          ""};
}

inline CLI::Validator address_by_its_form() {
  return {[](const std::string& text) {
            return host_and_port(text) ? std::string() : "'" + text + "'" + kNoAddress;
          },
          ""};
}

/// Rejects empty option values: a script whose variable is unset should fail instead of silently using the
/// default. Positional arguments may be empty. Call this after all options are defined.
inline void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options(
           [](const CLI::Option* o) { return !o->get_lnames().empty() && o->get_items_expected_max() > 0; }))
    option->transform(CLI::Validator(  // runs before the option's own checks
        [](const std::string& text) {
          return text.empty() ? "is empty; give a value, or omit the option" : std::string();
        },
        ""));
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    refuse_empty_values(*command);
}

}  // namespace longreach
