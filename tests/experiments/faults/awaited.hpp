#pragma once
// Kinds, groups of kinds and invariants that are left out of the swarm, because what they find is known and
// is being mended. Empty when all is well.

#include <algorithm>
#include <string_view>
#include <vector>

namespace longreach {

inline bool awaited(std::string_view name) {
  static const std::vector<std::string_view> kAwaited = {};
  return std::ranges::find(kAwaited, name) != kAwaited.end();
}

}  // namespace longreach
