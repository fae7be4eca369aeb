#pragma once
// Where a datagram came from, in the form of the channel that took it; nobody else reads it. All zero:
// nowhere.

#include <array>
#include <cstddef>

namespace longreach {

using Origin = std::array<std::byte, 28>;  // holds an IPv6 socket address

}  // namespace longreach
