#pragma once
// The clock of a side: CLOCK_BOOTTIME, which never goes backwards and keeps running while the host is
// suspended.

#include <time.h>

#include "common/core/time.hpp"

namespace longreach {

/// Returns the current time of the side's clock.
inline Time boottime_now() {
  timespec t{};
  clock_gettime(CLOCK_BOOTTIME, &t);
  return Time(std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec));
}

}  // namespace longreach
