#pragma once
// How many samples a property takes: all with LONGREACH_FULL set in the environment, a smoke size without.

#include <cstdlib>

namespace longreach {

inline int campaign(int full, int smoke) { return std::getenv("LONGREACH_FULL") != nullptr ? full : smoke; }

}  // namespace longreach
