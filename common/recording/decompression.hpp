#pragma once
// Unpacks the chunks of MCAP files that other programs compressed, by the system's libraries libzstd.so.1 and
// liblz4.so.1, which are loaded when the first such chunk is read. longreach's own recordings need neither.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// `how`: "zstd" or "lz4" (the frame format). `size`: of the result, bytes. Throws RecordingError for another
/// one, for a library that is missing and for bytes that are damaged.
std::string decompress(std::string_view how, std::string_view bytes, std::uint64_t size);

}  // namespace longreach
