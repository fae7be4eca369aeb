#pragma once
// The files of the installation, as the library finds them, and the conversion of errors.

#include <filesystem>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "deploy/library/include/longreach/error.hpp"

namespace longreach {

/// Returns $LONGREACH_HOME, else the `share/longreach` or `deploy` beside or above this library, else above
/// the working folder. Throws ConfigError.
std::filesystem::path library_files();

/// Searches the working folder, then library_files(). Throws ConfigError.
FileSearch library_search();

/// Returns the result of `run`; a ConfigError of it becomes an InputError.
template <class Run>
auto with_input_errors(const Run& run) {
  try {
    return run();
  } catch (const ConfigError& error) {
    throw InputError(error.what());
  }
}

/// Throws InputError "NAME = VALUE is outside LOW to HIGH" unless the value is in the range.
void require_range(const char* name, double value, double low, double high);

}  // namespace longreach
