#pragma once
// The 22 bytes in front of every datagram, big-endian:
//   version (1) | type (1) | session (8) | sequence (8) | checksum (4)
// The checksum is CRC-32 (IEEE 802.3, reflected, 0xEDB88320) over the first 18 bytes and the body. It finds
// damage; it does not authenticate.

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "common/link/envelope.hpp"

namespace longreach {

constexpr std::uint8_t kWireVersion = 1;
constexpr std::size_t kHeaderBytes = 22;
constexpr std::size_t kDatagramMaxBytes = 508;  // passes any IPv4 path unfragmented

/// CRC-32 of `bytes`; `before` is that of what went before them, so that pieces can be chained.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// Writes the header in front of the body. `datagram` holds kHeaderBytes of room, then the body.
void write_header(const Header& header, std::span<std::byte> datagram);

/// Reads and checks length, version, type (one of the known ones) and checksum, in this order.
std::variant<Header, Rejection> read_header(std::span<const std::byte> datagram);

}  // namespace longreach
