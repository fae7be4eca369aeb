#pragma once
// Runs a seed twice, with and without a change that must have no effect, and compares the trajectories of
// robot and hand bit for bit. Also checks that a run without faults raises no alarm.

#include <cstdint>
#include <optional>

#include "tests/faults/trial.hpp"

namespace longreach {

/// I17: forged, repeated, damaged and foreign datagrams that are injected throughout the run have no effect.
/// Returns std::nullopt if the link is random, because the added datagrams would consume its random numbers.
std::optional<bool> refused_changes_nothing(std::uint64_t seed);

/// Shifting both clocks by hours changes nothing.
bool clocks_change_nothing(std::uint64_t seed);

/// L4: runs the scenario of a seed without faults for `seconds`, over a link that loses 1 % of the datagrams.
Trial run_fault_free(std::uint64_t seed, double seconds);
/// Returns the number of holds, stops and faults. In a run without faults, each of them is a false alarm.
std::uint64_t false_alarms(const Trial& stable);

}  // namespace longreach
