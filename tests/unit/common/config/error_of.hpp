#pragma once
// The text of an expected ConfigError.

#include <string>
#include <utility>

#include "common/config/config.hpp"

namespace longreach {

/// Returns the text of the ConfigError; "no error" if `call` throws none. Other exceptions pass.
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
