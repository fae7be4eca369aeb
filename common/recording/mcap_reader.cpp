#include "common/recording/mcap_reader.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "common/recording/crc32.hpp"
#include "common/recording/decompression.hpp"
#include "common/recording/mcap_cursor.hpp"

namespace longreach {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::uint64_t kFooterBytes = kMcapRecordHead + 20;

std::string_view as_text(const std::array<char, kMcapRecordHead>& bytes) {
  return {bytes.data(), bytes.size()};
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
  std::error_code error;
  left_ = std::filesystem::file_size(path, error);
  if (error || !file_)
    throw RecordingError("cannot read " + path.string() + (error ? ": " + error.message() : ""));
  std::array<char, kMagic.size()> magic{};
  if (left_ < magic.size() || !file_.read(magic.data(), magic.size()) ||
      std::string_view(magic.data(), magic.size()) != kMagic)
    throw RecordingError(path.string() +
                         " is not a recording: it does not begin with the magic bytes of an MCAP file");
  left_ -= magic.size();
}

void McapReader::damaged(const std::string& why) const {
  throw RecordingError(path_.string() + " is damaged: " + why);
}

std::optional<McapMessage> McapReader::next() {
  try {
    while (!whole_) {
      const auto record = chunk_.empty() ? next_record() : next_in_chunk();
      if (!record) return std::nullopt;
      if (record->op == McapOp::kMessage) return message(record->content);
      take(*record);
    }
  } catch (const RecordingError& e) {
    if (std::string_view(e.what()).starts_with(path_.string())) throw;
    damaged(e.what());
  }
  return std::nullopt;
}

std::optional<McapReader::Record> McapReader::next_record() {
  std::array<char, kMcapRecordHead> head{};
  if (left_ < head.size() || !file_.read(head.data(), head.size())) return std::nullopt;
  left_ -= head.size();
  McapCursor cursor(as_text(head));
  const auto op = static_cast<McapOp>(cursor.take<std::uint8_t>());
  const auto length = cursor.take<std::uint64_t>();
  if (length > left_) return std::nullopt;  // cut here
  buffer_.resize(static_cast<std::size_t>(length));
  if (!file_.read(buffer_.data(), static_cast<std::streamsize>(length))) return std::nullopt;
  left_ -= length;
  return Record{op, buffer_};
}

std::optional<McapReader::Record> McapReader::next_in_chunk() {
  McapCursor cursor(chunk_);
  const auto op = static_cast<McapOp>(cursor.take<std::uint8_t>());
  const std::string_view content = cursor.take_bytes(cursor.take<std::uint64_t>());
  chunk_ = cursor.left();
  return Record{op, content};
}

void McapReader::open_chunk(std::string_view content) {
  McapCursor cursor(content);
  cursor.take_bytes(16);  // first and last time
  const auto size = cursor.take<std::uint64_t>();
  const auto crc = cursor.take<std::uint32_t>();
  const std::string_view compression = cursor.take_text();
  std::string_view records = cursor.take_bytes(cursor.take<std::uint64_t>());
  if (!compression.empty()) {
    try {
      unpacked_ = decompress(compression, records, size);
    } catch (const RecordingError& e) {
      throw RecordingError(path_.string() + ": " + e.what());
    }
    records = unpacked_;
  }
  if (records.size() != size) damaged("the size of a chunk differs from its stated size");
  if (crc != 0 && crc32(std::as_bytes(std::span(records))) != crc)
    damaged("a chunk has an incorrect checksum");
  chunk_ = records;
}

void McapReader::take(const Record& record) {
  McapCursor cursor(record.content);
  if (record.op == McapOp::kChunk) {
    open_chunk(record.content);
  } else if (record.op == McapOp::kSchema) {
    const auto id = cursor.take<std::uint16_t>();
    McapSchema& schema = schemas_[id];
    schema.name = cursor.take_text();
    schema.encoding = cursor.take_text();
    schema.descriptors = cursor.take_text();
  } else if (record.op == McapOp::kChannel) {
    const auto id = cursor.take<std::uint16_t>();
    McapChannel& channel = channels_[id];
    channel.id = id;
    channel.schema = cursor.take<std::uint16_t>();
    channel.topic = cursor.take_text();
    channel.encoding = cursor.take_text();
  } else if (record.op == McapOp::kMetadata) {
    const std::string name(cursor.take_text());
    metadata_[name] = cursor.take_map();
  } else if (record.op == McapOp::kDataEnd) {
    whole_ = true;
  }
}

McapMessage McapReader::message(std::string_view content) {
  McapCursor cursor(content);
  const auto channel = channels_.find(cursor.take<std::uint16_t>());
  if (channel == channels_.end()) damaged("a message belongs to an unknown channel");
  McapMessage out;
  out.channel = &channel->second;
  out.sequence = cursor.take<std::uint32_t>();
  out.log_time_ns = cursor.take<std::uint64_t>();
  cursor.take<std::uint64_t>();  // published
  out.bytes = cursor.left();
  return out;
}

namespace {

/// Where the summary begins; none: the file has none.
std::optional<std::uint64_t> summary_start(std::ifstream& file, std::uint64_t size) {
  constexpr std::uint64_t kTail = kFooterBytes + kMagic.size();
  if (size < kTail) return std::nullopt;
  std::string tail(kTail, '\0');
  file.seekg(static_cast<std::streamoff>(size - kTail));
  if (!file.read(tail.data(), static_cast<std::streamsize>(kTail))) return std::nullopt;
  McapCursor cursor(tail);
  if (cursor.take<std::uint8_t>() != static_cast<std::uint8_t>(McapOp::kFooter) || !tail.ends_with(kMagic))
    return std::nullopt;
  cursor.take<std::uint64_t>();
  const auto start = cursor.take<std::uint64_t>();
  return start > 0 && start < size - kTail ? std::optional(start) : std::nullopt;
}

std::optional<McapFigures> summarised(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(path);
  const auto start = summary_start(file, size);
  if (!start) return std::nullopt;
  std::string summary(static_cast<std::size_t>(size - *start), '\0');
  file.seekg(static_cast<std::streamoff>(*start));
  if (!file.read(summary.data(), static_cast<std::streamsize>(summary.size()))) return std::nullopt;
  McapCursor records(summary);
  while (records.left().size() > kMagic.size()) {
    const auto op = static_cast<McapOp>(records.take<std::uint8_t>());
    McapCursor content(records.take_bytes(records.take<std::uint64_t>()));
    if (op != McapOp::kStatistics) continue;
    McapFigures out{.messages = content.take<std::uint64_t>(), .whole = true};
    content.take_bytes(2 + 4 + 4 + 4 + 4);
    out.first_ns = content.take<std::uint64_t>();
    out.last_ns = content.take<std::uint64_t>();
    return out;
  }
  return std::nullopt;
}

}  // namespace

McapFigures mcap_figures(const std::filesystem::path& path) {
  McapReader reader(path);
  try {
    if (const auto figures = summarised(path)) return *figures;
  } catch (const RecordingError&) {
    // The messages themselves will tell.
  }
  McapFigures out;
  while (const auto message = reader.next()) {
    out.first_ns = out.messages == 0 ? message->log_time_ns : std::min(out.first_ns, message->log_time_ns);
    out.last_ns = std::max(out.last_ns, message->log_time_ns);
    ++out.messages;
  }
  out.whole = reader.whole();
  return out;
}

}  // namespace longreach
