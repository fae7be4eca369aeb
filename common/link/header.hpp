#pragma once
// The header of every datagram, 18 bytes, big-endian:
//   version (1) | type (1) | session (8) | sequence (8)
// The sealed body and its tag of 16 bytes follow (common/crypto). The header is not encrypted, but the tag
// covers it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "common/link/envelope.hpp"

namespace longreach {

constexpr std::uint8_t kWireVersion = 5;
constexpr std::size_t kHeaderBytes = 18;
constexpr std::size_t kOverheadBytes = kHeaderBytes + 16;  // header and tag
constexpr std::size_t kDatagramMaxBytes = 508;             // fits any IPv4 path without fragmentation

/// Writes the header to the first kHeaderBytes of `datagram`, which must be at least that long.
void write_header(const Header& header, std::span<std::byte> datagram);

/// Reads a header. Checks the length, the version and the type, in this order; an unknown type is rejected.
std::variant<Header, Rejection> read_header(std::span<const std::byte> datagram);

}  // namespace longreach
