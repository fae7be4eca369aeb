#include "common/config/field_text.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr std::size_t kMaxElements = 1000;  // of a list on a command line

std::string number_element_text(const Message& message, const FieldDescriptor* field, int i) {
  const Reflection* reflection = message.GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return format_number(field->is_repeated() ? reflection->GetRepeatedDouble(message, field, i)
                                                : reflection->GetDouble(message, field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(field->is_repeated() ? reflection->GetRepeatedUInt32(message, field, i)
                                                 : reflection->GetUInt32(message, field));
    default:
      throw ConfigError(field->full_name() + " has a type that a configuration cannot contain");
  }
}

std::string element_text(const Message& message, const FieldDescriptor* field, int i) {
  const Reflection* reflection = message.GetReflection();
  const bool repeated = field->is_repeated();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return (repeated ? reflection->GetRepeatedBool(message, field, i) : reflection->GetBool(message, field))
                 ? "true"
                 : "false";
    case FieldDescriptor::CPPTYPE_STRING:
      return repeated ? reflection->GetRepeatedString(message, field, i)
                      : reflection->GetString(message, field);
    case FieldDescriptor::CPPTYPE_ENUM:
      return (repeated ? reflection->GetRepeatedEnum(message, field, i) : reflection->GetEnum(message, field))
          ->name();
    default:
      return number_element_text(message, field, i);
  }
}

// A field name ends in its unit; "_per_s" is not a time.
bool in_seconds(const std::string& name) { return name.ends_with("_s") && !name.ends_with("_per_s"); }

// No unit and at most 1: a share of something, which people also write in percent.
bool is_fraction(const FieldDescriptor& field) {
  constexpr std::array<std::string_view, 14> kUnits{"m",  "rad", "s",  "n",  "nm", "hz", "j",
                                                    "kg", "m2",  "s2", "ns", "us", "ms", "bit"};
  const proto::Range& range = field.options().GetExtension(proto::range);
  const std::string_view name = field.name();
  const std::string_view last = name.substr(name.rfind('_') + 1);
  const bool has_unit =
      name.find('_') != std::string_view::npos && std::ranges::find(kUnits, last) != kUnits.end();
  return range.has_max() && range.max() == 1.0 && range.min() >= 0.0 && !has_unit;
}

double parse_double(const FieldDescriptor& field, std::string_view text, const std::string& path) {
  const bool seconds = in_seconds(field.name());
  const bool fraction = is_fraction(field);
  const auto value = seconds ? parse_seconds(text) : fraction ? parse_fraction(text) : parse_number(text);
  if (value) return *value;
  throw ConfigError(path + " = \"" + std::string(text) + "\" is not a finite decimal number" +
                    (seconds    ? " (in seconds, or followed by s, ms or us)"
                     : fraction ? " (plain, or followed by %)"
                                : ""));
}

bool parse_bool(std::string_view text, const std::string& path) {
  const std::string word = lower_case(text);
  if (word == "true" || word == "1" || word == "on") return true;
  if (word == "false" || word == "0" || word == "off") return false;
  throw ConfigError(path + " = \"" + std::string(text) + "\" is neither true (1, on) nor false (0, off)");
}

int parse_enum(const google::protobuf::EnumDescriptor& type, std::string_view text, const std::string& path) {
  for (int i = 0; i < type.value_count(); ++i) {
    if (lower_case(type.value(i)->name()) == lower_case(text)) return type.value(i)->number();
  }
  throw ConfigError(path + " = \"" + std::string(text) + "\" is not one of " + list_names(enum_names(type)));
}

void set_single(Message& message, const FieldDescriptor& field, std::string_view text,
                const std::string& path) {
  const Reflection* reflection = message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection->SetDouble(&message, &field, parse_double(field, text, path));
    case FieldDescriptor::CPPTYPE_UINT32: {
      const auto value = parse_integer<std::uint32_t>(text);
      if (value) return reflection->SetUInt32(&message, &field, *value);
      throw ConfigError(path + " = \"" + std::string(text) + "\" is not a whole number from 0 to 4294967295");
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection->SetBool(&message, &field, parse_bool(text, path));
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection->SetString(&message, &field, std::string(text));
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection->SetEnumValue(&message, &field, parse_enum(*field.enum_type(), text, path));
    default:
      throw ConfigError(path + " cannot be set from text");
  }
}

std::string_view trim(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string value_text(const Message& message, const PathStep& step) {
  if (!step.field->is_repeated() || step.index >= 0) return element_text(message, step.field, step.index);
  std::string text;
  const int size = message.GetReflection()->FieldSize(message, step.field);
  for (int i = 0; i < size; ++i) text += (i == 0 ? "" : ", ") + element_text(message, step.field, i);
  return text;
}

void set_value(Message& message, const FieldDescriptor& field, std::string_view text,
               const std::string& path) {
  if (!field.is_repeated()) return set_single(message, field, text, path);
  const Reflection* reflection = message.GetReflection();
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE)
    throw ConfigError(path + " cannot be set from text");
  reflection->ClearField(&message, &field);
  text = trim(text);
  if (text.starts_with('[') && text.ends_with(']')) text = trim(text.substr(1, text.size() - 2));
  if (text.empty()) return;
  for (std::size_t i = 0; i < kMaxElements; ++i) {
    const auto comma = text.find(',');
    const std::string element = path + "." + std::to_string(i);
    reflection->AddDouble(&message, &field, parse_double(field, trim(text.substr(0, comma)), element));
    if (comma == std::string_view::npos) return;
    text.remove_prefix(comma + 1);
  }
  throw ConfigError(path + " has more than " + std::to_string(kMaxElements) + " numbers");
}

}  // namespace longreach
