#pragma once
// Waits for the adapter before the first tick. A running adapter responds within a millisecond or two. If
// none responds, the program continues, and the loop reports a fault.

#include <chrono>
#include <thread>

#include "common/loop/real_time_loop.hpp"

namespace longreach {

/// Sends datagrams to the adapter until it responds, for at most 2 s.
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
