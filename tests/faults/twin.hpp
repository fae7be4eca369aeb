#pragma once
// Checks by running a seed twice: changes that must have no effect leave the trajectories of robot and hand
// the same, bit for bit. Also checks that a run without faults has no alarm.

#include <cstdint>
#include <optional>

#include "tests/faults/trial.hpp"

namespace longreach {

/// I17: forged, repeated, damaged and foreign datagrams are added all the time. Returns none for a random
/// link, whose random numbers the added datagrams would use.
std::optional<bool> refused_changes_nothing(std::uint64_t seed);

/// Both clocks are shifted by hours.
bool clocks_change_nothing(std::uint64_t seed);

/// L4: runs the scenario of a seed without a fault, over a link that loses 1 %, for `seconds`.
Trial run_fault_free(std::uint64_t seed, double seconds);
/// Returns the number of holds, stops and faults; all are false.
std::uint64_t false_alarms(const Trial& stable);

}  // namespace longreach
