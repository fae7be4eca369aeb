#include "common/recording/mcap_writer.hpp"

#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "common/core/check.hpp"
#include "common/recording/crc32.hpp"
#include "common/recording/mcap_format.hpp"
#include "proto/options.pb.h"

namespace longreach {
namespace {

constexpr std::string_view kEncoding = "protobuf";
constexpr std::size_t kChunkBytes = 1 << 20;  // a reader loads a chunk at a time

/// A record around what is added while it lives.
class Record {
 public:
  Record(ByteBuffer& buffer, McapOp op) : buffer_(buffer) {
    buffer_.add(static_cast<std::uint8_t>(op));
    begin_ = buffer_.begin_length<std::uint64_t>();
  }
  ~Record() { buffer_.end_length<std::uint64_t>(begin_); }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

 private:
  ByteBuffer& buffer_;
  std::size_t begin_ = 0;
};

/// What a reader of the recording needs of a file: without the options, and without the fields that are never recorded.
void reduce(google::protobuf::FileDescriptorProto& file) {
  std::vector<std::string> imports(file.dependency().begin(), file.dependency().end());
  std::erase(imports, proto::Range::descriptor()->file()->name());
  file.mutable_dependency()->Assign(imports.begin(), imports.end());
  file.clear_options();
  for (auto& message : *file.mutable_message_type()) {
    message.clear_options();
    auto& fields = *message.mutable_field();
    const auto shown = [](const auto& field) { return field.options().GetExtension(proto::shown); };
    // Those are at the end, and so are the oneofs that stand for their `optional`.
    const auto optional = std::ranges::count_if(
        fields, [&](const auto& field) { return shown(field) && field.proto3_optional(); });
    for (auto i = optional; i > 0; --i) message.mutable_oneof_decl()->RemoveLast();
    fields.erase(std::remove_if(fields.begin(), fields.end(), shown), fields.end());
    for (auto& field : fields) field.clear_options();
  }
  for (auto& type : *file.mutable_enum_type()) type.clear_options();
}

/// The file of a type after all files that it imports.
void add_file(const google::protobuf::FileDescriptor& file, std::set<std::string>& known,
              google::protobuf::FileDescriptorSet& out) {
  if (file.name() == proto::Range::descriptor()->file()->name() || !known.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) add_file(*file.dependency(i), known, out);
  file.CopyTo(out.add_file());
  reduce(*out.mutable_file()->rbegin());
}

std::string descriptors_of(const google::protobuf::Descriptor& type) {
  google::protobuf::FileDescriptorSet out;
  std::set<std::string> known;
  add_file(*type.file(), known, out);
  return out.SerializeAsString();
}

}  // namespace

void McapWriter::Span::include(std::uint64_t time) {
  first = any ? std::min(first, time) : time;
  last = any ? std::max(last, time) : time;
  any = true;
}

McapWriter::McapWriter(RecordingFile& file, const std::string& library) : file_(file) {
  out_.add_bytes(kMcapMagic);
  {
    const Record header(out_, McapOp::kHeader);
    out_.add_text("");  // no profile
    out_.add_text(library);
  }
  put();
}

void McapWriter::put() {
  if (file_.append(out_.bytes())) data_crc_ = crc32(out_.bytes(), data_crc_);
  out_.clear();
}

void McapWriter::add_metadata(const std::string& name, const TextMap& entries) {
  flush();
  const std::uint64_t offset = file_.size();
  {
    const Record metadata(out_, McapOp::kMetadata);
    out_.add_text(name);
    out_.add_map(entries);
  }
  metadata_.push_back({name, offset, out_.size()});
  put();
}

std::uint16_t McapWriter::schema_of(const google::protobuf::Descriptor& type) {
  const auto known = std::find_if(schemas_.begin(), schemas_.end(),
                                  [&type](const Schema& s) { return s.name == type.full_name(); });
  if (known != schemas_.end()) return static_cast<std::uint16_t>(known - schemas_.begin() + 1);
  schemas_.push_back({type.full_name(), descriptors_of(type)});
  const auto id = static_cast<std::uint16_t>(schemas_.size());
  add_schema(chunk_, id);
  return id;
}

void McapWriter::add_schema(ByteBuffer& to, std::uint16_t id) const {
  const Schema& schema = schemas_[id - 1u];
  const Record record(to, McapOp::kSchema);
  to.add(id);
  to.add_text(schema.name);
  to.add_text(kEncoding);
  to.add_text(schema.descriptors);
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const google::protobuf::Descriptor& type) {
  channels_.push_back({schema_of(type), topic});
  const auto id = static_cast<std::uint16_t>(channels_.size());
  add_channel_record(chunk_, id);
  return id;
}

void McapWriter::add_channel_record(ByteBuffer& to, std::uint16_t id) const {
  const Channel& channel = channels_[id - 1u];
  const Record record(to, McapOp::kChannel);
  to.add(id);
  to.add(channel.schema);
  to.add_text(channel.topic);
  to.add_text(kEncoding);
  to.add_map({});
}

void McapWriter::write(std::uint16_t id, std::uint64_t log_time_ns,
                       const google::protobuf::Message& message) {
  CHECK(id >= 1 && id <= channels_.size());
  if (file_.failed()) return;
  if (chunk_.size() >= kChunkBytes) flush();
  Channel& channel = channels_[id - 1u];
  channel.index.emplace_back(log_time_ns, chunk_.size());
  const Record record(chunk_, McapOp::kMessage);
  chunk_.add(id);
  chunk_.add(channel.messages++);
  chunk_.add(log_time_ns);
  chunk_.add(log_time_ns);  // published when logged
  const std::size_t size = message.ByteSizeLong();
  message.SerializeWithCachedSizesToArray(reinterpret_cast<std::uint8_t*>(chunk_.extend(size)));
  chunk_span_.include(log_time_ns);
  span_.include(log_time_ns);
  ++messages_;
}

void McapWriter::flush() {
  if (chunk_.size() == 0) return;
  ChunkPlace place{.span = chunk_span_, .offset = file_.size(), .size = chunk_.size()};
  {
    const Record record(out_, McapOp::kChunk);
    out_.add(place.span.first);
    out_.add(place.span.last);
    out_.add(place.size);
    out_.add(crc32(chunk_.bytes()));
    out_.add_text("");  // not compressed
    out_.add(place.size);
    out_.add_bytes(chunk_.bytes());
  }
  place.length = out_.size();
  add_indexes(place);
  put();
  if (!file_.failed()) chunks_.push_back(std::move(place));
  chunk_.clear();
  chunk_span_ = Span{};
}

void McapWriter::add_indexes(ChunkPlace& place) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    if (channel.index.empty()) continue;
    const auto id = static_cast<std::uint16_t>(i + 1);
    place.indexes.emplace_back(id, file_.size() + out_.size());
    const Record record(out_, McapOp::kMessageIndex);
    out_.add(id);
    const std::size_t begin = out_.begin_length();
    for (const auto& [time, offset] : channel.index) {
      out_.add(time);
      out_.add(offset);
    }
    out_.end_length(begin);
    channel.index.clear();
  }
  place.index_length = out_.size() - place.length;
}

void McapWriter::finish() {
  flush();
  {
    const Record end(out_, McapOp::kDataEnd);
    out_.add(data_crc_);
  }
  put();
  add_summary(file_.size());
  put();
}

void McapWriter::add_summary(std::uint64_t start) {
  struct Group {
    McapOp op;
    std::uint64_t offset, length;
  };
  std::vector<Group> groups;
  const auto group = [&](McapOp op, const auto& fill) {
    const std::size_t begin = out_.size();
    fill();
    if (out_.size() > begin) groups.push_back({op, start + begin, out_.size() - begin});
  };
  group(McapOp::kSchema, [&] {
    for (std::size_t i = 0; i < schemas_.size(); ++i) add_schema(out_, static_cast<std::uint16_t>(i + 1));
  });
  group(McapOp::kChannel, [&] {
    for (std::size_t i = 0; i < channels_.size(); ++i)
      add_channel_record(out_, static_cast<std::uint16_t>(i + 1));
  });
  group(McapOp::kStatistics, [&] { add_statistics(); });
  group(McapOp::kChunkIndex, [&] {
    for (const ChunkPlace& place : chunks_) add_chunk_index(place);
  });
  group(McapOp::kMetadataIndex, [&] {
    for (const MetadataPlace& place : metadata_) {
      const Record record(out_, McapOp::kMetadataIndex);
      out_.add(place.offset);
      out_.add(place.length);
      out_.add_text(place.name);
    }
  });
  const std::uint64_t offsets_start = start + out_.size();
  for (const Group& g : groups) {
    const Record record(out_, McapOp::kSummaryOffset);
    out_.add(static_cast<std::uint8_t>(g.op));
    out_.add(g.offset);
    out_.add(g.length);
  }
  out_.add(static_cast<std::uint8_t>(McapOp::kFooter));
  out_.add(std::uint64_t{20});
  out_.add(start);
  out_.add(offsets_start);
  out_.add(crc32(out_.bytes()));  // over its own record, too, up to here
  out_.add_bytes(kMcapMagic);
}

void McapWriter::add_statistics() {
  const Record record(out_, McapOp::kStatistics);
  out_.add(messages_);
  out_.add(static_cast<std::uint16_t>(schemas_.size()));
  out_.add(static_cast<std::uint32_t>(channels_.size()));
  out_.add(std::uint32_t{0});  // attachments
  out_.add(static_cast<std::uint32_t>(metadata_.size()));
  out_.add(static_cast<std::uint32_t>(chunks_.size()));
  out_.add(span_.first);
  out_.add(span_.last);
  const std::size_t begin = out_.begin_length();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].messages == 0) continue;
    out_.add(static_cast<std::uint16_t>(i + 1));
    out_.add(std::uint64_t{channels_[i].messages});
  }
  out_.end_length(begin);
}

void McapWriter::add_chunk_index(const ChunkPlace& place) {
  const Record record(out_, McapOp::kChunkIndex);
  out_.add(place.span.first);
  out_.add(place.span.last);
  out_.add(place.offset);
  out_.add(place.length);
  const std::size_t begin = out_.begin_length();
  for (const auto& [channel, offset] : place.indexes) {
    out_.add(channel);
    out_.add(offset);
  }
  out_.end_length(begin);
  out_.add(place.index_length);
  out_.add_text("");
  out_.add(place.size);
  out_.add(place.size);
}

}  // namespace longreach
