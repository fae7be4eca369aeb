#pragma once
// Number of samples for a statistical test or experiment: `full` if LONGREACH_FULL is set in the environment,
// otherwise the smaller number `smoke`.

#include <cstdlib>

namespace longreach {

inline int campaign(int full, int smoke) { return std::getenv("LONGREACH_FULL") != nullptr ? full : smoke; }

}  // namespace longreach
