#pragma once
// Decompresses chunks of MCAP files written by other programs, with the system libraries libzstd.so.1 and
// liblz4.so.1, which are loaded on first use. longreach's own recordings are not compressed.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// `how`: "zstd" or "lz4" (the frame format). `size`: bytes of the result. Throws RecordingError for another
/// format, a missing library or corrupted data.
std::string decompress(std::string_view how, std::string_view bytes, std::uint64_t size);

}  // namespace longreach
