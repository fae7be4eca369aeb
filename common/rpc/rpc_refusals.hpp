#pragma once
// Counts and logs refused RPC connections and calls: connections with a failed handshake (no certificate, one
// of another site, an expired or forged one, no TLS), which are taken from gRPC's own log, and calls that the
// role of the caller does not permit. At most one log line per second, which gives the number since the last
// one. gRPC does not report the address of a connection with a failed handshake.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// Redirects gRPC's log, whose lines would appear next to error messages: refused connections are counted,
/// the remainder is dropped. It affects the whole program; every channel and server of longreach calls it.
void take_rpc_log();

/// `who`: an address, or "connection"; followed by "role=... certificate=..." if there is a certificate.
void note_rpc_refusal(std::string_view who, std::string_view why);

/// Converts gRPC's "ipv6:%5B::1%5D:53211" to "[::1]:53211".
std::string readable_peer(const std::string& peer);

/// Number since the start of the program.
std::uint64_t rpc_refusals();

}  // namespace longreach
