#pragma once
// Where a datagram came from, in the format of the channel that received it; no other code interprets it: the
// address of the sender and, if the channel has several addresses of its own, the one that the datagram was
// sent to. If all bytes are zero, there is no address.

#include <array>
#include <cstdint>

namespace longreach {

using Origin = std::array<std::uint8_t, 44>;  // large enough for an IPv6 socket address and an IPv6 address
inline constexpr Origin kNowhere{};

}  // namespace longreach
