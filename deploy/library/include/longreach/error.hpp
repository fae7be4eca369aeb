#pragma once
// The exception of liblongreach.

#include <stdexcept>
#include <string>

namespace longreach {

/// An argument, a setting or a file is not valid. what() is one sentence: which field, line or argument, its value, and
/// what is allowed.
class [[gnu::visibility("default")]] InputError : public std::invalid_argument {
 public:
  explicit InputError(const std::string& sentence);
  ~InputError() override;
};

/// Version of the library, e.g. "0.1.0".
[[gnu::visibility("default")]] std::string library_version();

}  // namespace longreach
