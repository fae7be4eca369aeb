#pragma once
// Addresses in user notation: "127.0.0.1:47001", "[::1]:47001", "robot.local:47001". Resolving a name may
// block, so it is done at start only.

#include <asio/ip/udp.hpp>
#include <stdexcept>
#include <string>

namespace longreach {

/// One sentence that names the invalid address and the expected form.
class AddressError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws AddressError. Port 0 means any free port.
asio::ip::udp::endpoint parse_udp_address(const std::string& text);

/// The notation that parse_udp_address reads.
std::string to_string(const asio::ip::udp::endpoint& endpoint);

}  // namespace longreach
