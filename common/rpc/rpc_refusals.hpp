#pragma once
// Counts and logs refused RPC connections and calls. Failed handshakes (no TLS, or a certificate that is
// missing, expired, forged or from another site) are extracted from gRPC's own log, which does not contain
// the address of the peer. Calls are refused if the role of the caller does not permit them. At most one line
// per second is logged; it contains the number of refusals since the previous line.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// Replaces gRPC's log output, which would otherwise appear between the error messages: refused connections
/// are counted, and all other lines are dropped. Affects the whole program; called for every longreach
/// channel and server.
void take_rpc_log();

/// Counts and logs a refusal. `who` is an address or "connection", followed by "role=... certificate=..." if
/// there is a certificate.
void note_rpc_refusal(std::string_view who, std::string_view why);

/// Converts gRPC's "ipv6:%5B::1%5D:53211" to "[::1]:53211".
std::string readable_peer(const std::string& peer);

/// Returns the number of refusals since the program started.
std::uint64_t rpc_refusals();

}  // namespace longreach
