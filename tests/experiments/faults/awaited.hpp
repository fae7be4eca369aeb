#pragma once
// Kinds and invariants that are left out of the swarm, because what they find is known and is being mended.
// Empty when all is well.

#include <algorithm>
#include <array>
#include <string_view>

namespace longreach {

inline bool awaited(std::string_view name) {
  constexpr std::array kAwaited = {
      std::string_view("I23"),         std::string_view("handle-drifts"), std::string_view("slave-frozen"),
      std::string_view("both-frozen"), std::string_view("held-up-burst"), std::string_view("held-burst"),
      std::string_view("delayed-up"),  std::string_view("delayed-down"),  std::string_view("delay-creeps"),
      std::string_view("delay-step"),  std::string_view("joint-numbers"), std::string_view("force-numbers")};
  constexpr std::array kGroups = {std::string_view("force sensor"), std::string_view("robot"),
                                  std::string_view("contact")};
  return std::ranges::find(kAwaited, name) != kAwaited.end() ||
         std::ranges::find(kGroups, name) != kGroups.end();
}

}  // namespace longreach
