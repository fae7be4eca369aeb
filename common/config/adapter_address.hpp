#pragma once
// Where an adapter listens: unix:/PATH, a socket of this machine, whose owner the system tells.

#include <string>

namespace longreach {

/// Why that is none and what to write, or empty. By its form.
std::string adapter_address_trouble(const std::string& address);
/// Of an address: its path.
std::string adapter_path(const std::string& address);

}  // namespace longreach
