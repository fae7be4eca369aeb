#include "common/io/recording/csv_export.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "common/io/recording/mcap_reader.hpp"
#include "common/io/recording/recording_error.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr int kDepthMax = 8;  // of nested messages; types may contain themselves

/// Where a cell comes from: fields from the message inwards.
using Column = std::vector<const FieldDescriptor*>;

void add_columns(const google::protobuf::Descriptor& type, const Column& above, std::vector<Column>& out) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    Column column = above;
    column.push_back(field);
    const bool nested = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !field->is_repeated();
    if (!nested) {
      out.push_back(std::move(column));
    } else if (column.size() < kDepthMax) {
      add_columns(*field->message_type(), column, out);
    }
  }
}

std::string name_of(const Column& column) {
  std::string name;
  for (const FieldDescriptor* field : column) name += (name.empty() ? "" : ".") + field->name();
  return name;
}

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

std::string value_text(const Message& message, const FieldDescriptor& field) {
  const auto& r = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number_text(r.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return number_text(r.GetFloat(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return number_text(r.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return number_text(r.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return number_text(r.GetUInt32(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return number_text(r.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return r.GetBool(message, &field) ? "1" : "0";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const int value = r.GetEnumValue(message, &field);
      const auto* known = field.enum_type()->FindValueByNumber(value);
      return known != nullptr ? known->name() : number_text(value);
    }
    default:
      return csv_quoted(r.GetString(message, &field));
  }
}

std::string repeated_text(const Message& message, const FieldDescriptor& field) {
  const int size = message.GetReflection()->FieldSize(message, &field);
  std::string out;
  for (int i = 0; i < size; ++i) {
    std::string text;
    google::protobuf::TextFormat::PrintFieldValueToString(message, &field, i, &text);
    out += (i > 0 ? " " : "") + text;
  }
  return csv_quoted(out);
}

std::string cell(const Message& message, const Column& column) {
  const Message* inner = &message;
  for (const FieldDescriptor* field : column) {
    const auto& r = *inner->GetReflection();
    if (field->is_repeated()) return repeated_text(*inner, *field);
    if (field->has_presence() && !r.HasField(*inner, field)) return "";
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) return value_text(*inner, *field);
    inner = &r.GetMessage(*inner, field);
  }
  return "";
}

/// The type of a topic, from the descriptors in the file, and its table.
class Table {
 public:
  Table(const McapSchema& schema, const std::filesystem::path& file)
      : out_(file, std::ios::binary), table_{file} {
    google::protobuf::FileDescriptorSet files;
    if (schema.encoding != "protobuf" || !files.ParseFromString(schema.descriptors))
      throw RecordingError("the schema " + schema.name + " is not of protobuf");
    for (const auto& one : files.file())
      if (pool_.BuildFile(one) == nullptr)
        throw RecordingError("the schema " + schema.name + " is not whole");
    const auto* type = pool_.FindMessageTypeByName(schema.name);
    if (type == nullptr) throw RecordingError("the schema " + schema.name + " is not whole");
    message_.reset(factory_.GetPrototype(type)->New());
    add_columns(*type, {}, columns_);
    out_ << "t_s,log_time_ns";
    for (const Column& column : columns_) out_ << ',' << name_of(column);
    out_ << '\n';
  }

  void add(const McapMessage& message, std::uint64_t first_ns) {
    if (!message_->ParseFromArray(message.bytes.data(), static_cast<int>(message.bytes.size())))
      throw RecordingError("a message of " + message.channel->topic + " does not follow its schema");
    const auto since_ns = static_cast<std::int64_t>(message.log_time_ns - first_ns);
    out_ << number_text(1e-9 * static_cast<double>(since_ns)) << ',' << message.log_time_ns;
    for (const Column& column : columns_) out_ << ',' << cell(*message_, column);
    out_ << '\n';
    ++table_.rows;
  }

  CsvTable finish() {
    out_.close();
    if (!out_) throw RecordingError("cannot write " + table_.file.string());
    return table_;
  }

 private:
  google::protobuf::DescriptorPool pool_;
  google::protobuf::DynamicMessageFactory factory_{&pool_};
  std::unique_ptr<Message> message_;
  std::vector<Column> columns_;
  std::ofstream out_;
  CsvTable table_;
};

std::string file_name(const std::string& topic) {
  std::string name = topic.substr(topic.starts_with('/') ? 1 : 0);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return name + ".csv";
}

}  // namespace

CsvExport export_csv(const std::filesystem::path& recording, const std::filesystem::path& folder) {
  McapReader reader(recording);
  auto message = reader.next();
  if (!message)
    throw RecordingError(recording.string() + (reader.whole() ? " holds no messages" : " is cut") +
                         ": there is nothing to export");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RecordingError("cannot make the folder " + folder.string() + ": " + error.message());
  const std::uint64_t first_ns = message->log_time_ns;
  std::map<std::uint16_t, std::unique_ptr<Table>> tables;
  for (; message; message = reader.next()) {
    auto& table = tables[message->channel->id];
    if (!table)
      table = std::make_unique<Table>(reader.schemas().at(message->channel->schema),
                                      folder / file_name(message->channel->topic));
    table->add(*message, first_ns);
  }
  CsvExport out;
  out.whole = reader.whole();
  for (const auto& [channel, table] : tables) out.tables.push_back(table->finish());
  return out;
}

}  // namespace longreach
