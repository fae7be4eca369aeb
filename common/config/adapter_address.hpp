#pragma once
// Addresses of adapters: unix:/PATH names a socket on this machine. The operating system reports which user
// owns the other end.

#include <string>

namespace longreach {

/// Returns an empty string if the text has the form of an adapter address; otherwise what is wrong with it
/// and what to write instead. Does not access the socket.
std::string adapter_address_trouble(const std::string& address);
/// Returns the path that an adapter address contains.
std::string adapter_path(const std::string& address);

}  // namespace longreach
