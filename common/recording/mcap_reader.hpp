#pragma once
// Reads the messages of an MCAP file from start to end, in the order in which they were written. It needs no
// summary: a truncated file ends with its last complete record. Lengths are checked before allocation, chunks
// against their CRC. Compressed chunks of other programs (zstd, lz4) are supported.
//
// Attachments are skipped.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

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
  const McapChannel* channel = nullptr;  // valid as long as the reader
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::string_view bytes{};  // valid until the next message
};

class McapReader {
 public:
  /// Throws RecordingError if the file cannot be read or is not an MCAP file.
  explicit McapReader(const std::filesystem::path& path);

  /// Returns the next message; none at the end, and whole() then tells whether the file was completed. Throws
  /// RecordingError if the file is damaged.
  std::optional<McapMessage> next();
  [[nodiscard]] bool whole() const { return whole_; }

  [[nodiscard]] const std::map<std::uint16_t, McapSchema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }
  [[nodiscard]] const std::map<std::string, TextMap>& metadata() const { return metadata_; }

 private:
  struct Record {
    McapOp op{};
    std::string_view content{};
  };

  /// Returns the next record of the file or of the present chunk; none if there is no further complete one.
  std::optional<Record> next_record();
  std::optional<Record> next_in_chunk();
  void open_chunk(std::string_view content);
  void take(const Record& record);
  McapMessage message(std::string_view content);
  [[noreturn]] void damaged(const std::string& why) const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::uint64_t left_ = 0;  // remaining bytes of the file
  std::string buffer_;      // the present record of the file
  std::string unpacked_;    // the present chunk, if it was compressed
  std::string_view chunk_;  // remainder of the present chunk, in buffer_ or unpacked_
  bool whole_ = false;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::string, TextMap> metadata_;
};

/// Content of a file, from its summary if it has one.
struct McapFigures {
  std::uint64_t messages = 0;
  std::uint64_t first_ns = 0, last_ns = 0;  // log times; 0 without messages
  bool whole = false;
};
/// Throws RecordingError.
McapFigures mcap_figures(const std::filesystem::path& path);

}  // namespace longreach
