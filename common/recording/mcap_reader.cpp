#include "common/recording/mcap_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
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
  while (!whole_) {
    in_chunk_ = !chunk_.empty();
    try {
      const auto record = in_chunk_ ? next_in_chunk() : next_record();
      if (!record) break;
      in_chunk_ = in_chunk_ || record->op == McapOp::kChunk;
      if (record->op == McapOp::kMessage) {
        McapMessage out = message(record->content);
        any_ = true;
        return out;
      }
      take(*record);
    } catch (const RecordingError& e) {
      if (!in_chunk_) {
        if (std::string_view(e.what()).starts_with(path_.string())) throw;
        damaged(e.what());
      }
      skip_chunk(e.what());
    }
  }
  if (!any_ && !lost_.empty()) {
    if (lost_.front().why.starts_with(path_.string())) throw RecordingError(lost_.front().why);
    damaged(lost_.front().why);
  }
  return std::nullopt;
}

void McapReader::skip_chunk(const std::string& why) {
  const std::string before = path_.string() + " is damaged: ";
  lost_.push_back({head_.first_ns, head_.last_ns, why.starts_with(before) ? why.substr(before.size()) : why});
  chunk_ = {};
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
  head_ = {};
  head_.first_ns = cursor.take<std::uint64_t>();
  head_.last_ns = cursor.take<std::uint64_t>();
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

std::string lost_sentence(const std::vector<LostChunk>& lost, std::uint64_t zero_ns) {
  if (lost.empty()) return "";
  constexpr std::size_t kShown = 5;
  const auto seconds = [zero_ns](std::uint64_t ns) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3f",
                  1e-9 * static_cast<double>(static_cast<std::int64_t>(ns - zero_ns)));
    return std::string(text);
  };
  std::string text;
  for (std::size_t i = 0; i < std::min(lost.size(), kShown); ++i)
    text += (i == 0 ? "" : ", ") + seconds(lost[i].first_ns) + " s to " + seconds(lost[i].last_ns) + " s";
  if (lost.size() > kShown) text += " and " + std::to_string(lost.size() - kShown) + " more periods";
  return "data is lost from " + text + ", because " + lost.front().why;
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
