#pragma once
// Origin of a datagram, in the format of the channel that received it; no other code reads it. All zero:
// none.

#include <array>
#include <cstdint>

namespace longreach {

using Origin = std::array<std::uint8_t, 28>;  // holds an IPv6 socket address
inline constexpr Origin kNowhere{};

}  // namespace longreach
