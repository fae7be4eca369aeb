#pragma once
// Addresses as a user writes them: "127.0.0.1:47001", "[::1]:47001", "robot.local:47001". Names are resolved,
// which may wait: at start only.

#include <asio/ip/udp.hpp>
#include <stdexcept>
#include <string>

namespace longreach {

/// One sentence that says which address is wrong and what is expected.
class AddressError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws AddressError. Port 0 stands for any free one.
asio::ip::udp::endpoint parse_udp_address(const std::string& text);

/// The notation that parse_udp_address reads.
std::string to_string(const asio::ip::udp::endpoint& endpoint);

}  // namespace longreach
