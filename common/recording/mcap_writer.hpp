#pragma once
// Writes an MCAP file of protobuf messages with their schemas. The file consists of header, metadata, chunks
// with message indexes, a summary (schemas, channels, statistics, chunk and metadata indexes, offsets) and
// footer. It is uncompressed and protected by CRCs.
//
// Messages are collected in a chunk, which is written as a whole when it is large enough or when flush() is
// called. A file that ends after a chunk lacks only the summary, which finish() writes. After a write error,
// all further calls have no effect.
//
// Attachments, compression and other encodings are not supported.

#include <google/protobuf/message.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/recording/byte_buffer.hpp"
#include "common/recording/recording_file.hpp"

namespace longreach {

class McapWriter {
 public:
  /// `file` must be empty and outlive the writer. `library` is the name of the writing program.
  McapWriter(RecordingFile& file, const std::string& library);

  /// Call this before the first message, so that even a truncated file contains the metadata.
  void add_metadata(const std::string& name, const TextMap& entries);
  std::uint16_t add_channel(const std::string& topic, const google::protobuf::Descriptor& type);
  void write(std::uint16_t channel, std::uint64_t log_time_ns, const google::protobuf::Message& message);

  /// Writes the current chunk, unless it is empty.
  void flush();
  /// Writes the current chunk, the summary and the footer.
  void finish();

  /// Size of the file so far, including the current chunk but not the summary.
  [[nodiscard]] std::uint64_t size() const { return file_.size() + chunk_.size(); }
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  struct Span {
    std::uint64_t first = 0, last = 0;  // log times, ns
    bool any = false;
    void include(std::uint64_t time);
  };
  struct Channel {
    std::uint16_t schema = 0;
    std::string topic;
    std::uint32_t messages = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index{};  // log time, offset in the current chunk
  };
  struct Schema {
    std::string name;
    std::string descriptors;  // serialised FileDescriptorSet
  };
  struct ChunkPlace {
    Span span{};
    std::uint64_t offset = 0, length = 0, size = 0, index_length = 0;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes{};  // channel, offset of its message index
  };
  struct MetadataPlace {
    std::string name;
    std::uint64_t offset = 0, length = 0;
  };

  /// Writes the content of `out_` to the file.
  void put();
  std::uint16_t schema_of(const google::protobuf::Descriptor& type);
  void add_schema(ByteBuffer& to, std::uint16_t id) const;
  void add_channel_record(ByteBuffer& to, std::uint16_t id) const;
  void add_indexes(ChunkPlace& place);
  void add_chunk_index(const ChunkPlace& place);
  void add_statistics();
  void add_summary(std::uint64_t start);

  RecordingFile& file_;
  std::uint32_t data_crc_ = 0;  // CRC of the file so far
  ByteBuffer out_;
  ByteBuffer chunk_;
  Span chunk_span_{}, span_{};
  std::vector<Schema> schemas_;    // the id of a schema is its index + 1
  std::vector<Channel> channels_;  // the id of a channel is its index + 1
  std::vector<ChunkPlace> chunks_;
  std::vector<MetadataPlace> metadata_;
  std::uint64_t messages_ = 0;
};

}  // namespace longreach
