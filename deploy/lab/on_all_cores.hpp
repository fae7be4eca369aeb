#pragma once
// Runs independent trials in parallel on all cores available to this process.

#include <cstddef>
#include <functional>

namespace longreach {

/// Calls `one` with each number from 0 to `count` - 1, in several threads. Calls with different numbers must
/// not write to the same data. `progress`, if given, is called in this thread with the completed fraction.
/// Rethrows the exception of the lowest number whose call throws, however fast the threads are. `one` may call
/// on_all_cores() itself: all calls together use one thread per core.
void on_all_cores(std::size_t count, const std::function<void(std::size_t)>& one,
                  const std::function<void(double)>& progress = {});

}  // namespace longreach
