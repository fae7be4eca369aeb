#include "deploy/cli/record/csv_export.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/quiet_protobuf.hpp"
#include "common/recording/recording_error.hpp"
#include "common/recording/topic_decoder.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

template <class Number>
std::string number_text(Number value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string repeated_text(const RecordedValue& value) {
  const int size = value.message->GetReflection()->FieldSize(*value.message, value.field);
  std::string out;
  for (int i = 0; i < size; ++i) out += (i > 0 ? " " : "") + text_of(value, i);
  return csv_quoted(out);
}

std::string cell(const Message& message, const RecordedColumn& column) {
  const RecordedValue value = value_in(message, column);
  if (value.message == nullptr) return "";
  if (value.field->is_repeated()) return repeated_text(value);
  const std::string text = text_of(value);
  const bool quotable = value.field->cpp_type() == FieldDescriptor::CPPTYPE_STRING;
  return quotable ? csv_quoted(text) : text;
}

/// The type of a topic, from the descriptors in the file, and its table.
class Table {
 public:
  Table(const McapSchema& schema, const std::filesystem::path& file) : decoder_(schema), table_{file} {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored))
      throw RecordingError(file.string() + " already exists; remove it, or give another folder with --out");
    out_.open(file, std::ios::binary);
    made_ = true;
    out_ << "t_s,log_time_ns";
    for (const RecordedColumn& column : decoder_.columns()) out_ << ',' << name_of(column);
    out_ << '\n';
  }

  /// Counts a message that does not follow the schema.
  void add(const McapMessage& message, std::uint64_t first_ns) {
    if (!decoder_.decode(message.bytes)) {
      ++bad_;
      return;
    }
    const auto since_ns = static_cast<std::int64_t>(message.log_time_ns - first_ns);
    out_ << number_text(1e-9 * static_cast<double>(since_ns)) << ',' << message.log_time_ns;
    for (const RecordedColumn& column : decoder_.columns()) out_ << ',' << cell(decoder_.message(), column);
    out_ << '\n';
    if (!out_) fail();
    ++table_.rows;
  }

  CsvTable finish() {
    out_.close();
    if (!out_) fail();
    return table_;
  }
  [[nodiscard]] bool empty() const { return table_.rows == 0; }
  [[nodiscard]] std::uint64_t bad() const { return bad_; }
  /// Removes what was written.
  void undo() {
    std::error_code ignored;
    if (made_) std::filesystem::remove(table_.file, ignored);
  }

 private:
  [[noreturn]] void fail() const {
    throw RecordingError("cannot write " + table_.file.string() + ": " +
                         (errno != 0 ? std::strerror(errno) : "unknown reason"));
  }

  TopicDecoder decoder_;
  std::ofstream out_;
  bool made_ = false;
  std::uint64_t bad_ = 0;
  CsvTable table_;
};

std::string file_name(const std::string& topic) {
  std::string name = topic.substr(topic.starts_with('/') ? 1 : 0);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  constexpr std::size_t kLengthMax = 200;
  return name.empty() ? "topic" : name.substr(0, kLengthMax);
}

/// Made with the first file in it; removed again with what was made above it, where nothing lies there.
class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
  const std::filesystem::path& make() {
    std::error_code error;
    for (auto one = path_; !one.empty() && !std::filesystem::exists(one, error); one = one.parent_path())
      made_.push_back(one);
    std::filesystem::create_directories(path_, error);
    if (error) throw RecordingError("cannot create the folder " + path_.string() + ": " + error.message());
    return path_;
  }
  void undo() {
    std::error_code ignored;
    for (const auto& one : made_) std::filesystem::remove(one, ignored);
  }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // innermost first
};

/// The tables of one recording.
class Tables {
 public:
  Tables(const McapReader& reader, std::filesystem::path folder)
      : reader_(reader), folder_(std::move(folder)) {}

  void add(const McapMessage& message, std::uint64_t zero_ns) {
    const McapChannel& channel = *message.channel;
    const auto schema = reader_.schemas().find(channel.schema);
    const bool has_schema = schema != reader_.schemas().end();
    const std::string other = reason_not_decodable(channel, has_schema ? &schema->second : nullptr);
    if (!other.empty()) {
      skipped_.insert(channel.topic + " (" + other + ")");
      return;
    }
    if (damaged_.contains(channel.id)) return;
    auto& table = tables_[channel.id];
    try {
      if (!table) table = std::make_unique<Table>(schema->second, free_name(channel.topic));
    } catch (const SchemaError& e) {
      damaged_[channel.id] = channel.topic + ", because " + e.what();
      return;
    }
    table->add(message, zero_ns);
  }

  CsvExport finish() {
    CsvExport out;
    out.skipped.assign(skipped_.begin(), skipped_.end());
    for (const auto& [channel, why] : damaged_) out.damaged.push_back(why);
    for (const auto& [channel, table] : tables_) {
      if (!table) continue;
      if (table->bad() > 0)
        out.damaged.push_back(std::to_string(table->bad()) +
                              (table->bad() == 1 ? " message does" : " messages do") +
                              " not match the schema of " + reader_.channels().at(channel).topic);
      const CsvTable written = table->finish();
      if (table->empty()) table->undo();
      if (!table->empty()) out.tables.push_back(written);
    }
    if (out.tables.empty()) folder_.undo();
    return out;
  }
  void undo() {
    for (const auto& [channel, table] : tables_) {
      if (table) table->undo();
    }
    folder_.undo();
  }

 private:
  /// Two topics of one recording may have one name.
  std::filesystem::path free_name(const std::string& topic) {
    const std::string name = file_name(topic);
    std::string free = name;
    for (int i = 2; !names_.insert(free).second; ++i) free = name + "_" + std::to_string(i);
    return folder_.make() / (free + ".csv");
  }

  const McapReader& reader_;
  Folder folder_;
  std::map<std::uint16_t, std::string> damaged_;  // why
  std::map<std::uint16_t, std::unique_ptr<Table>> tables_;
  std::set<std::string> names_, skipped_;
};

std::string comma_separated(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + text;
  return out;
}

}  // namespace

CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder,
                     std::uint64_t zero_ns) {
  McapReader reader(recording);
  auto message = reader.next();
  if (!message)
    throw RecordingError(
        recording.string() +
        (reader.whole() ? " contains no messages" : " is truncated before its first message") +
        ": nothing can be exported");
  const QuietProtobuf quiet;
  const std::uint64_t first_ns = zero_ns == 0 ? message->log_time_ns : zero_ns;
  Tables tables(reader, folder);
  try {
    std::uint64_t last_ns = first_ns;
    for (; message; message = reader.next()) {
      tables.add(*message, first_ns);
      last_ns = std::max(last_ns, message->log_time_ns);
    }
    CsvExport out = tables.finish();
    if (!reader.lost().empty()) out.damaged.push_back(lost_sentence(reader.lost(), first_ns));
    out.whole = reader.whole();
    out.last_s = 1e-9 * static_cast<double>(last_ns - first_ns);
    if (!out.tables.empty()) return out;
    if (!out.damaged.empty())
      throw RecordingError(recording.string() +
                           " is damaged and cannot be exported: " + comma_separated(out.damaged));
    throw RecordingError(recording.string() +
                         " contains no protobuf messages, and no others can be exported; skipped: " +
                         comma_separated(out.skipped));
  } catch (const RecordingError&) {
    tables.undo();
    throw;
  }
}

}  // namespace longreach
