#pragma once
// The clock of a side: CLOCK_BOOTTIME, which never goes back and continues while the host is suspended.

#include <time.h>

#include "common/core/time.hpp"

namespace longreach {

inline Time boottime_now() {
  timespec t{};
  clock_gettime(CLOCK_BOOTTIME, &t);
  return Time(std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec));
}

}  // namespace longreach
