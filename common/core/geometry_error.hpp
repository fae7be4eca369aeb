#pragma once
// A mechanism that cannot be built. Thrown at start-up only; the text names the parameter and says what is
// wrong.

#include <stdexcept>

namespace longreach {

class GeometryError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace longreach
