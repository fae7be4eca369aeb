#pragma once
// Tests of a port by the doctor: connections, usage, arrival of datagrams.

#include <cstdint>
#include <string>

namespace longreach {

/// Returns whether a TCP connection to address:port is accepted within the time.
bool takes_connections(const std::string& address, double timeout_s);
/// Returns whether a UDP port of this machine is in use.
bool udp_port_taken(const std::string& address);

struct Probe {
  std::uint64_t sent = 0;
  int mtu = 0;          // of the path as the system knows it, bytes; 0: unknown
  std::string error{};  // of the last one that could not be sent
};
/// Sends five datagrams of 508 bytes, unfragmented, that both sides reject by their version.
Probe send_probe(const std::string& address);

}  // namespace longreach
