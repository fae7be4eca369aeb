#pragma once
// Writes an MCAP file of protobuf messages with their schemas: header, metadata, chunks with their message
// indexes, summary with schemas, channels, statistics, chunk and metadata indexes, offsets, footer; all with
// CRCs, uncompressed.
//
// Messages are collected in a chunk until it is large enough, or until flush(); the chunk is then written at
// once. A file that ends there is complete except for its summary, which finish() writes. After a write error
// all calls have no effect.
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
  /// `file` is empty and outlives the writer. `library` is the name of the writing program.
  McapWriter(RecordingFile& file, const std::string& library);

  /// Call it before the first message, so that a truncated file contains the metadata.
  void add_metadata(const std::string& name, const TextMap& entries);
  std::uint16_t add_channel(const std::string& topic, const google::protobuf::Descriptor& type);
  void write(std::uint16_t channel, std::uint64_t log_time_ns, const google::protobuf::Message& message);

  /// Ends the present chunk, unless it is empty.
  void flush();
  /// Ends the file.
  void finish();

  /// Includes the present chunk, but not the summary.
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
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index{};  // in the present chunk: log time, offset
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
  std::uint32_t data_crc_ = 0;  // of the file so far
  ByteBuffer out_;
  ByteBuffer chunk_;
  Span chunk_span_{}, span_{};
  std::vector<Schema> schemas_;    // id: index + 1
  std::vector<Channel> channels_;  // likewise
  std::vector<ChunkPlace> chunks_;
  std::vector<MetadataPlace> metadata_;
  std::uint64_t messages_ = 0;
};

}  // namespace longreach
