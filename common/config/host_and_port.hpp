#pragma once
// Network addresses as users write them: "127.0.0.1:47001", "[::1]:47001", "robot.local:47001".

#include <cstdint>
#include <optional>
#include <string>

namespace longreach {

struct HostAndPort {
  std::string host;  // without the brackets of an IPv6 address
  std::uint16_t port = 0;
};

/// Returns none if the text is not a valid address. Does not resolve the host name.
std::optional<HostAndPort> host_and_port(const std::string& text);

/// Describes the expected form at the end of an error message.
inline constexpr const char* kNoAddress =
    " is not an address; write address:port, e.g. 127.0.0.1:47001 or [::1]:47001, with a port from 0 to "
    "65535";

}  // namespace longreach
