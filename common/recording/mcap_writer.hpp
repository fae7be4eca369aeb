#pragma once
// Writes an MCAP file of protobuf messages that brings its own schemas: header, metadata, chunks with their
// message indexes, summary with schemas, channels, statistics, chunk and metadata indexes, offsets, footer;
// all with CRCs, uncompressed.
//
// Messages gather in a chunk until it is large enough, or flush(): then it goes to the system as one piece,
// and a file that ends there is whole up to there, only without its summary. finish() writes the summary.
// Once the file has failed, everything is ignored.
//
// Does not handle: attachments, compression, other encodings.

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
  /// `file` is empty and outlives the writer. `library` names who writes.
  McapWriter(RecordingFile& file, const std::string& library);

  /// Before the first message, so that a file that is cut has it.
  void add_metadata(const std::string& name, const TextMap& entries);
  std::uint16_t add_channel(const std::string& topic, const google::protobuf::Descriptor& type);
  void write(std::uint16_t channel, std::uint64_t log_time_ns, const google::protobuf::Message& message);

  /// Ends the chunk, if it holds something.
  void flush();
  /// Ends the file.
  void finish();

  /// With what waits in the chunk, without the summary.
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

  /// Puts what was gathered in `out_` into the file.
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
  std::vector<Schema> schemas_;    // id: place + 1
  std::vector<Channel> channels_;  // likewise
  std::vector<ChunkPlace> chunks_;
  std::vector<MetadataPlace> metadata_;
  std::uint64_t messages_ = 0;
};

}  // namespace longreach
