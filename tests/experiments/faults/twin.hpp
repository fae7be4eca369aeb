#pragma once
// I17: what is refused changes nothing but counters. The same run twice, once with forged, repeated, damaged
// and foreign datagrams added all the time: the trajectories of robot and hand are the same, bit for bit.

#include <cstdint>
#include <optional>

namespace longreach {

/// Whether both runs of this seed are the same; none where its link is one of chance, which the added
/// datagrams would use up.
std::optional<bool> refused_changes_nothing(std::uint64_t seed);

}  // namespace longreach
