#pragma once
// What must not matter, tried by running a seed twice: the trajectories of robot and hand are the same, bit
// for bit. And what must not happen where nothing goes wrong.

#include <cstdint>
#include <optional>

#include "tests/faults/trial.hpp"

namespace longreach {

/// I17: forged, repeated, damaged and foreign datagrams are added all the time. None where the link is one of
/// chance, which the added datagrams would use up.
std::optional<bool> refused_changes_nothing(std::uint64_t seed);

/// Both clocks show other times, by hours.
bool clocks_change_nothing(std::uint64_t seed);

/// L4: the scenario of a seed without a fault, over a link that loses 1 %, for so long.
Trial run_fault_free(std::uint64_t seed, double seconds);
/// Holds, stops and faults that it had; all are false.
std::uint64_t false_alarms(const Trial& stable);

}  // namespace longreach
