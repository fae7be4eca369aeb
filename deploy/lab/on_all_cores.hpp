#pragma once
// Runs independent trials on all cores available to this process.

#include <cstddef>
#include <functional>

namespace longreach {

/// Calls `one` with each number below `count`, several in parallel; `one` must write to separate places for
/// each number. `progress`, if given, is called in this thread with the completed share. Throws the first
/// exception of `one`.
void on_all_cores(std::size_t count, const std::function<void(std::size_t)>& one,
                  const std::function<void(double)>& progress = {});

}  // namespace longreach
