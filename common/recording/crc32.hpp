#pragma once
// CRC-32 with the polynomial 0xEDB88320 (reflected), as in MCAP, zlib and Ethernet.

#include <cstddef>
#include <cstdint>
#include <span>

namespace longreach {

/// CRC of `bytes`, continued from the CRC `before` of preceding data; 0: none.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace longreach
