#pragma once
// Where a datagram came from, in the form of the channel that took it; nobody else reads it. All zero:
// nowhere.

#include <array>
#include <cstdint>

namespace longreach {

using Origin = std::array<std::uint8_t, 28>;  // holds an IPv6 socket address
inline constexpr Origin kNowhere{};

}  // namespace longreach
