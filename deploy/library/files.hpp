#pragma once
// Finds the files of the installation, and converts errors to InputError.

#include <filesystem>

#include "common/config/config.hpp"
#include "common/config/file_search.hpp"
#include "deploy/library/include/longreach/error.hpp"

namespace longreach {

/// Returns $LONGREACH_HOME if it is set, otherwise the `share/longreach` or `deploy` folder next to or above
/// this library, otherwise the nearest one above the working folder. Throws ConfigError.
std::filesystem::path library_files();

/// Returns a file search over the working folder and then library_files(). Throws ConfigError.
FileSearch library_search();

/// Returns the result of `run`. A ConfigError is rethrown as an InputError.
template <class Run>
auto with_input_errors(const Run& run) {
  try {
    return run();
  } catch (const ConfigError& error) {
    throw InputError(error.what());
  }
}

/// Throws an InputError "NAME = VALUE is outside LOW to HIGH" if the value is not in the range.
void require_range(const char* name, double value, double low, double high);

}  // namespace longreach
