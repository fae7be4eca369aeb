#pragma once
// The exception of liblongreach.

#include <stdexcept>
#include <string>

namespace longreach {

/// Thrown for an invalid argument, setting or file. what() is one sentence that names the argument, field or
/// line, its value, and the permitted values.
class [[gnu::visibility("default")]] InputError : public std::invalid_argument {
 public:
  explicit InputError(const std::string& sentence);
  ~InputError() override;
};

/// Version of the library, e.g. "0.1.0".
[[gnu::visibility("default")]] std::string library_version();

}  // namespace longreach
