#pragma once
// Independent trials on every core that this process may use.

#include <cstddef>
#include <functional>

namespace longreach {

/// Calls `one` with each number below `count`, several at once; what `one` writes must have a place for each.
/// `progress`, if any, is told the share done, by this thread. Throws the first that `one` throws.
void on_all_cores(std::size_t count, const std::function<void(std::size_t)>& one,
                  const std::function<void(double)>& progress = {});

}  // namespace longreach
