#pragma once
// Probes of `longreach doctor` that check whether a port accepts connections, is in use, or receives datagrams.

#include <cstdint>
#include <string>

namespace longreach {

/// Returns whether a TCP connection to `address` (HOST:PORT) is accepted within 15 s.
bool takes_connections(const std::string& address);
/// Returns whether a UDP port on this machine is in use.
bool udp_port_taken(const std::string& address);

struct Probe {
  std::uint64_t sent = 0;
  int mtu = 0;          // path MTU known to the kernel, bytes; 0: unknown
  std::string error{};  // error of the last failed send
};
/// Sends five unfragmented datagrams of 508 bytes, which either side rejects because their version is 0.
Probe send_probe(const std::string& address);

}  // namespace longreach
