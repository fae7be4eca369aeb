#pragma once
// Before the first tick: an adapter that runs answers within a millisecond or two. One that does not is a
// fault, which the loop then shows.

#include <chrono>
#include <thread>

#include "common/loop/real_time_loop.hpp"

namespace longreach {

/// Greets until the adapter answers, at most 2 s.
template <class Adapter>
void wait_for_adapter(Adapter& adapter) {
  const Time end = boottime_now() + std::chrono::seconds(2);
  do {
    adapter.greet();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (adapter.read(boottime_now()).ok) return;
  } while (boottime_now() < end);
}

}  // namespace longreach
