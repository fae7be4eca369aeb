#include "deploy/lab/recording/message_difference.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>

#include "common/core/check.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// A numeric field as bits, which differ if the values differ, and as text.
struct Value {
  std::uint64_t bits = 0;
  std::string text;
};

Value value_of(const Message& message, const FieldDescriptor& field) {
  const auto& r = *message.GetReflection();
  if (field.has_presence() && !r.HasField(message, &field)) return {0, "absent"};
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      const double value = r.GetDouble(message, &field);
      return {std::bit_cast<std::uint64_t>(value), number_text(value)};
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      return {r.GetBool(message, &field), r.GetBool(message, &field) ? "true" : "false"};
    case FieldDescriptor::CPPTYPE_ENUM:
      return {static_cast<std::uint64_t>(r.GetEnumValue(message, &field)),
              r.GetEnum(message, &field)->name()};
    case FieldDescriptor::CPPTYPE_UINT32:
      return {r.GetUInt32(message, &field), std::to_string(r.GetUInt32(message, &field))};
    case FieldDescriptor::CPPTYPE_UINT64:
      return {r.GetUInt64(message, &field), std::to_string(r.GetUInt64(message, &field))};
    case FieldDescriptor::CPPTYPE_INT32:
      return {static_cast<std::uint64_t>(r.GetInt32(message, &field)),
              std::to_string(r.GetInt32(message, &field))};
    case FieldDescriptor::CPPTYPE_INT64:
      return {static_cast<std::uint64_t>(r.GetInt64(message, &field)),
              std::to_string(r.GetInt64(message, &field))};
    default:
      return {0, r.GetString(message, &field)};
  }
}

std::optional<MessageDifference> in_message(const Message& a, const Message& b,
                                            const FieldDescriptor& field) {
  const auto& r = *a.GetReflection();
  const bool in_a = r.HasField(a, &field), in_b = r.HasField(b, &field);
  if (in_a != in_b)
    return MessageDifference{field.name(), in_a ? "there" : "absent", in_b ? "there" : "absent"};
  if (!in_a) return std::nullopt;
  auto inner = first_difference(r.GetMessage(a, &field), r.GetMessage(b, &field));
  if (inner) inner->field = field.name() + "." + inner->field;
  return inner;
}

}  // namespace

std::optional<MessageDifference> first_difference(const Message& a, const Message& b) {
  CHECK(a.GetDescriptor() == b.GetDescriptor());
  for (int i = 0; i < a.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *a.GetDescriptor()->field(i);
    CHECK(!field.is_repeated());
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      if (auto inner = in_message(a, b, field)) return inner;
      continue;
    }
    const Value of_a = value_of(a, field), of_b = value_of(b, field);
    if (of_a.bits != of_b.bits || of_a.text != of_b.text)
      return MessageDifference{field.name(), of_a.text, of_b.text};
  }
  return std::nullopt;
}

}  // namespace longreach
