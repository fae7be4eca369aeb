#pragma once
// A mechanism that cannot be built. Thrown at start-up only; the text names the parameter and says what is
// wrong.

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace longreach {

class GeometryError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// `value`, if it is finite.
inline double require_finite(std::string_view name, double value) {
  if (!std::isfinite(value)) throw GeometryError(std::string(name) + " is not a finite number");
  return value;
}

}  // namespace longreach
