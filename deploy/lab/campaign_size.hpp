#pragma once
// Number of samples of a property: all with LONGREACH_FULL set in the environment, otherwise a small number.

#include <cstdlib>

namespace longreach {

inline int campaign(int full, int smoke) { return std::getenv("LONGREACH_FULL") != nullptr ? full : smoke; }

}  // namespace longreach
