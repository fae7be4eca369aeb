#pragma once
// Decompresses chunks of MCAP files that other programs wrote. Uses the system libraries libzstd.so.1 and
// liblz4.so.1, which are loaded on first use. longreach's own recordings are not compressed.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// Decompresses `bytes` to `size` bytes. `how` is "zstd" or "lz4" (the frame format). Throws RecordingError
/// for other formats, a missing library or corrupted data.
std::string decompress(std::string_view how, std::string_view bytes, std::uint64_t size);

}  // namespace longreach
