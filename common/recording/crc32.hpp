#pragma once
// CRC-32 with the polynomial 0xEDB88320 (reflected), as in MCAP, zlib and Ethernet.

#include <cstddef>
#include <cstdint>
#include <span>

namespace longreach {

/// Returns the CRC of `bytes`. `before` is the CRC of the preceding data, or 0 if there is none.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace longreach
