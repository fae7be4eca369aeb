#include "common/recording/topic_decoder.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/text_format.h>

#include <charconv>
#include <set>

#include "common/text/utf8.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr int kDepthMax = 8;  // of nested messages; types may contain themselves

void add_columns(const google::protobuf::Descriptor& type, const RecordedColumn& above,
                 std::vector<RecordedColumn>& out) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    RecordedColumn column = above;
    column.push_back(field);
    const bool nested = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !field->is_repeated();
    if (!nested) {
      out.push_back(std::move(column));
    } else if (column.size() < kDepthMax) {
      add_columns(*field->message_type(), column, out);
    }
  }
}

template <class Number>
std::string shortest_text(Number value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace

std::string name_of(const RecordedColumn& column) {
  std::string name;
  for (const FieldDescriptor* field : column) name += (name.empty() ? "" : ".") + field->name();
  return name;
}

RecordedValue value_in(const Message& message, const RecordedColumn& column) {
  const Message* inner = &message;
  for (const FieldDescriptor* field : column) {
    const auto& r = *inner->GetReflection();
    if (field->is_repeated()) return {inner, field};
    if (field->has_presence() && !r.HasField(*inner, field)) return {};
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) return {inner, field};
    inner = &r.GetMessage(*inner, field);
  }
  return {};
}

std::string text_of(const RecordedValue& value, int element) {
  std::string text;
  google::protobuf::TextFormat::PrintFieldValueToString(*value.message, value.field, element, &text);
  return text;
}

std::string text_of(const RecordedValue& value) {
  const Message& message = *value.message;
  const FieldDescriptor& field = *value.field;
  const auto& r = *message.GetReflection();
  if (field.type() == FieldDescriptor::TYPE_BYTES) {
    const std::string text = text_of(value, -1);
    return text.substr(1, text.size() - 2);
  }
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return shortest_text(r.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return shortest_text(r.GetFloat(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return shortest_text(r.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return shortest_text(r.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return shortest_text(r.GetUInt32(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return shortest_text(r.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return r.GetBool(message, &field) ? "1" : "0";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const int number = r.GetEnumValue(message, &field);
      const auto* known = field.enum_type()->FindValueByNumber(number);
      return known != nullptr ? known->name() : shortest_text(number);
    }
    default:
      return r.GetString(message, &field);
  }
}

std::string reason_not_decodable(const McapChannel& channel, const McapSchema* schema) {
  if (channel.encoding != "protobuf") return channel.encoding.empty() ? "no encoding" : channel.encoding;
  if (schema == nullptr) return "no schema";
  return schema->encoding == "protobuf" ? "" : "its schema has the encoding " + schema->encoding;
}

TopicDecoder::TopicDecoder(const McapSchema& schema) {
  google::protobuf::FileDescriptorSet files;
  if (!files.ParseFromString(schema.descriptors))
    throw SchemaError("the schema " + schema.name + " cannot be read");
  std::set<std::string> names;
  for (const auto& one : files.file()) {  // in any order, and possibly twice
    if (names.insert(one.name()).second) (void)files_.Add(one);
  }
  const auto* type = pool_.FindMessageTypeByName(schema.name);
  if (type == nullptr)
    throw SchemaError(
        "the schema " + schema.name + " cannot be used: " +
        (error_.text.empty() ? "it does not define a message of that name" : printable(error_.text)));
  message_.reset(factory_.GetPrototype(type)->New());
  add_columns(*type, {}, columns_);
}

bool TopicDecoder::decode(std::string_view bytes) {
  return message_->ParsePartialFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace longreach
