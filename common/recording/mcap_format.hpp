#pragma once
// Constants of the MCAP format (mcap.dev/spec). A file consists of a magic number, header, data, summary,
// footer and the magic number again. Everything between the magic numbers is a sequence of records: a
// one-byte opcode, an eight-byte length and the content.

#include <array>
#include <cstddef>
#include <cstdint>

namespace longreach {

enum class McapOp : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kMetadata = 12,
  kMetadataIndex = 13,
  kSummaryOffset = 14,
  kDataEnd = 15
};

constexpr std::array<std::byte, 8> kMcapMagic = {std::byte{0x89}, std::byte{'M'}, std::byte{'C'},
                                                 std::byte{'A'},  std::byte{'P'}, std::byte{'0'},
                                                 std::byte{'\r'}, std::byte{'\n'}};
constexpr std::size_t kMcapRecordHead = 9;    // opcode and length
constexpr std::size_t kMcapMessageHead = 22;  // channel, sequence and two times before the data of a message

}  // namespace longreach
