#pragma once
// Error for a mechanism that cannot be built. It is thrown only at start-up; the message names the parameter
// and the problem.

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace longreach {

class GeometryError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Returns `value` if it is finite; otherwise throws GeometryError with `name` in the message.
inline double require_finite(std::string_view name, double value) {
  if (!std::isfinite(value)) throw GeometryError(std::string(name) + " is not a finite number");
  return value;
}

}  // namespace longreach
