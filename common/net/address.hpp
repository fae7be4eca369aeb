#pragma once
// Network addresses as users write them: "127.0.0.1:47001", "[::1]:47001", "robot.local:47001". Names are
// only resolved when a program starts, because this may block.

#include <asio/ip/udp.hpp>
#include <stdexcept>
#include <string>

namespace longreach {

/// Error for an invalid address: one sentence that contains the address and the expected form.
class AddressError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses an address and resolves its host name. Port 0 stands for any free port. Throws AddressError.
asio::ip::udp::endpoint parse_udp_address(const std::string& text);

/// Returns the address in the form that parse_udp_address accepts.
std::string to_string(const asio::ip::udp::endpoint& endpoint);

}  // namespace longreach
