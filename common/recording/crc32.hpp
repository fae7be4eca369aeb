#pragma once
// CRC-32 with the polynomial 0xEDB88320 (reflected), as MCAP, zlib and Ethernet have it.

#include <cstddef>
#include <cstdint>
#include <span>

namespace longreach {

/// Of `bytes` behind what has the CRC `before`; 0: nothing was before.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace longreach
