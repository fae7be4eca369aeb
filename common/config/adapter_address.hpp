#pragma once
// Addresses of adapters: unix:/PATH names a socket on this machine. The operating system reports which user
// owns the other end.

#include <string>

namespace longreach {

/// Returns an empty string if the text is a well-formed adapter address; otherwise describes the error and
/// the expected form. Does not access the socket.
std::string adapter_address_trouble(const std::string& address);
/// Returns the path in an adapter address.
std::string adapter_path(const std::string& address);

}  // namespace longreach
