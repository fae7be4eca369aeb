#pragma once
// Captures the message of an expected ConfigError.

#include <string>
#include <utility>

#include "common/config/config.hpp"

namespace longreach {

/// Returns the message of the ConfigError that `call` throws, or "no error" if it throws none. Other
/// exceptions propagate.
template <class Call>
std::string error_of(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace longreach
