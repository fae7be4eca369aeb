#pragma once
// Address of an adapter: unix:/PATH, a socket on this machine, whose owner the system reports.

#include <string>

namespace longreach {

/// Returns why the text is not such an address and what to write, or empty. It checks the form only.
std::string adapter_address_trouble(const std::string& address);
/// Returns the path in an address.
std::string adapter_path(const std::string& address);

}  // namespace longreach
