#pragma once
// Who was turned away by RPC, counted and logged: connections that fail their handshake (no certificate, one
// of another site, an expired or forged one, no TLS at all), as gRPC's own log tells them, and calls that the
// caller's role may not make. One log line a second at most, which says how many there were since the last
// one. gRPC does not report the address of a connection whose
// handshake failed.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// Takes gRPC's log: its lines would stand beside the one sentence of an error. Refused connections are
/// noted, the rest is dropped. For the whole program; every channel and server of ours calls it.
void take_rpc_log();

/// `who`: an address, or "connection"; then "role=... certificate=..." where one was shown.
void note_rpc_refusal(std::string_view who, std::string_view why);

/// "[::1]:53211" of gRPC's "ipv6:%5B::1%5D:53211".
std::string readable_peer(const std::string& peer);

/// Since the program's start.
std::uint64_t rpc_refusals();

}  // namespace longreach
