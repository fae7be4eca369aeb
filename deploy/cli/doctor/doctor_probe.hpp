#pragma once
// What the doctor tries at a port: whether somebody takes connections, has the port, gets datagrams.

#include <cstdint>
#include <string>

namespace longreach {

/// Whether a TCP connection to address:port is taken within the time.
bool takes_connections(const std::string& address, double timeout_s);
/// Whether a UDP port of this machine cannot be had.
bool udp_port_taken(const std::string& address);

struct Probe {
  std::uint64_t sent = 0;
  int mtu = 0;          // of the path as the system knows it, bytes; 0: not known
  std::string error{};  // of the last one that could not be sent
};
/// Sends five datagrams of 508 bytes that both sides reject before they look at anything but the version,
/// without permission to fragment them.
Probe send_probe(const std::string& address);

}  // namespace longreach
