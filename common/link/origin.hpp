#pragma once
// Source address of a datagram, in the format of the channel that received it; no other code interprets it.
// If all bytes are zero, there is no address.

#include <array>
#include <cstdint>

namespace longreach {

using Origin = std::array<std::uint8_t, 28>;  // large enough for an IPv6 socket address
inline constexpr Origin kNowhere{};

}  // namespace longreach
