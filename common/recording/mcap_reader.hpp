#pragma once
// Reads the messages of an MCAP file from start to end, in the order in which they were written. The summary
// is not required: a truncated file is read up to its last complete record. Lengths are checked before memory
// is allocated, and chunks are checked against their CRC. A damaged chunk is skipped, and lost() reports the
// period that it covers. Compressed chunks (zstd, lz4), which other programs write, are supported.
//
// Attachments are skipped.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/recording/byte_buffer.hpp"
#include "common/recording/mcap_format.hpp"

namespace longreach {

struct McapSchema {
  std::string name;
  std::string encoding;
  std::string descriptors;  // serialised FileDescriptorSet
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;
};

struct McapMessage {
  const McapChannel* channel = nullptr;  // valid during the lifetime of the reader
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::string_view bytes{};  // valid until the next message
};

/// A chunk that is damaged: the period that its head states, and the reason.
struct LostChunk {
  std::uint64_t first_ns = 0, last_ns = 0;
  std::string why;
};

class McapReader {
 public:
  /// Throws RecordingError if the file cannot be read or is not an MCAP file.
  explicit McapReader(const std::filesystem::path& path);

  /// Returns the next message, or none at the end of the file; whole() then reports whether the file is
  /// complete. Throws RecordingError if the file is damaged outside its chunks, or if no chunk can be read.
  std::optional<McapMessage> next();
  [[nodiscard]] bool whole() const { return whole_; }
  /// Returns the damaged chunks that were skipped so far. Messages before the damage in such a chunk may have been
  /// returned, if it has no checksum.
  [[nodiscard]] const std::vector<LostChunk>& lost() const { return lost_; }

  [[nodiscard]] const std::map<std::uint16_t, McapSchema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }
  [[nodiscard]] const std::map<std::string, TextMap>& metadata() const { return metadata_; }

 private:
  struct Record {
    McapOp op{};
    std::string_view content{};
  };

  /// Returns the next record of the current chunk or of the file, or none if no complete record follows.
  std::optional<Record> next_record();
  std::optional<Record> next_in_chunk();
  void open_chunk(std::string_view content);
  void take(const Record& record);
  McapMessage message(std::string_view content);
  /// Discards the remainder of the current chunk.
  void skip_chunk(const std::string& why);
  [[noreturn]] void damaged(const std::string& why) const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t left_ = 0;  // remaining bytes of the file
  std::string buffer_;      // current record of the file
  std::string unpacked_;    // current chunk, if it was compressed
  std::string_view chunk_;  // remainder of the current chunk, in buffer_ or unpacked_
  LostChunk head_;          // period of the current chunk
  bool in_chunk_ = false;   // a record of the current chunk is being processed
  std::vector<LostChunk> lost_;
  bool any_ = false;  // a message was returned
  bool whole_ = false;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::string, TextMap> metadata_;
};

/// Returns one sentence about the lost chunks, with times in seconds after `zero_ns`; empty if there are none.
std::string lost_sentence(const std::vector<LostChunk>& lost, std::uint64_t zero_ns);

/// Statistics of a file, from its summary if it has one.
struct McapFigures {
  std::uint64_t messages = 0;
  std::uint64_t first_ns = 0, last_ns = 0;  // log times; 0 if there are no messages
  bool whole = false;
};
/// Reads the statistics of a file. Throws RecordingError.
McapFigures mcap_figures(const std::filesystem::path& path);

}  // namespace longreach
