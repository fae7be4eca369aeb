#pragma once
// The 18 bytes in front of every datagram, big-endian:
//   version (1) | type (1) | session (8) | sequence (8)
// The sealed body and its tag of 16 bytes follow (common/crypto). The header is not encrypted; the tag covers
// it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "common/link/envelope.hpp"

namespace longreach {

constexpr std::uint8_t kWireVersion = 4;
constexpr std::size_t kHeaderBytes = 18;
constexpr std::size_t kOverheadBytes = kHeaderBytes + 16;  // with the tag
constexpr std::size_t kDatagramMaxBytes = 508;             // passes any IPv4 path unfragmented

/// Writes the header in front of the body. `datagram` has at least kHeaderBytes.
void write_header(const Header& header, std::span<std::byte> datagram);

/// Reads and checks length, version and type (one of the known ones), in this order.
std::variant<Header, Rejection> read_header(std::span<const std::byte> datagram);

}  // namespace longreach
