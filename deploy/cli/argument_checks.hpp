#pragma once
// Checks of command-line arguments that must be numbers or addresses. They throw a UsageError if the argument
// is invalid.

#include <optional>
#include <string>
#include <string_view>

#include "common/config/host_and_port.hpp"
#include "common/text/number_text.hpp"
#include "deploy/cli/invocation.hpp"

namespace longreach {

inline double bounded(const char* what, const std::string& text, std::optional<double> value, double min,
                      double max, const char* unit) {
  if (value && *value >= min && *value <= max) return *value;
  throw UsageError(std::string(what) + " = " + text + " is not a number from " + format_number(min) + " to " +
                   format_number(max) + unit);
}

inline void check_address(const char* option, const std::string& address,
                          const char* example = "127.0.0.1:47010") {
  const auto parts = host_and_port(address);
  if (parts && parts->port > 0) return;
  throw UsageError(std::string(option) + " = " + address + " is not HOST:PORT, e.g. " + example);
}

}  // namespace longreach
