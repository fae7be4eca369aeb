#include "deploy/cli/view_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value + 0.0);  // no negative zero
  return text.data();
}

std::string text_of(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number_text(reflection.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(reflection.GetUInt32(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(reflection.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(reflection.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return std::to_string(reflection.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnum(message, &field)->name();
    default:
      return "";
  }
}

/// The numbers of a vector, quaternion or of joints in one line; empty if the message is another one.
std::string numbers_of(const Message& message) {
  std::string text;
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    const bool number = field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
    if (!number || (field.name().size() > 1 && !field.name().starts_with("joint"))) return "";
    text += (i > 0 ? " " : "") + text_of(message, field);
  }
  return text;
}

void add(const Message& message, const std::string& above, std::vector<NamedValue>& out) {
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    if (field.is_repeated() || (field.has_presence() && !reflection.HasField(message, &field))) continue;
    const std::string name = above + field.name();
    if (field.message_type() == nullptr) {
      out.push_back({name, text_of(message, field)});
      continue;
    }
    const Message& inner = reflection.GetMessage(message, &field);
    std::string numbers = numbers_of(inner);
    if (numbers.empty()) {
      add(inner, name + ".", out);
    } else {
      out.push_back({name, std::move(numbers)});
    }
  }
}

}  // namespace

std::vector<NamedValue> values_of(const Message& message) {
  std::vector<NamedValue> values;
  add(message, "", values);
  return values;
}

std::string values_table(const Message& message) {
  const std::vector<NamedValue> values = values_of(message);
  std::size_t width = 0;
  for (const NamedValue& value : values) width = std::max(width, value.name.size() + 2);
  std::string text;
  for (const NamedValue& value : values)
    text += value.name + std::string(width - value.name.size(), ' ') + value.value + "\n";
  return text;
}

}  // namespace longreach
