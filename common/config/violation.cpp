#include "common/config/violation.hpp"

#include <cmath>
#include <numbers>

#include "common/config/config.hpp"
#include "common/config/field_text.hpp"
#include "common/text/number_text.hpp"
#include "common/text/utf8.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

std::optional<double> number_at(const Message& message, const PathStep& step) {
  const Reflection* reflection = message.GetReflection();
  const FieldDescriptor* field = step.field;
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return field->is_repeated() ? reflection->GetRepeatedDouble(message, field, step.index)
                                  : reflection->GetDouble(message, field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return field->is_repeated() ? reflection->GetRepeatedUInt32(message, field, step.index)
                                  : reflection->GetUInt32(message, field);
    default:
      return std::nullopt;
  }
}

std::string text_at(const Message& message, const PathStep& step) {
  const Reflection* reflection = message.GetReflection();
  return step.field->is_repeated() ? reflection->GetRepeatedString(message, step.field, step.index)
                                   : reflection->GetString(message, step.field);
}

// What a number breaks, as the end of a sentence; nothing if it is allowed.
std::string broken_range(double value, const FieldDescriptor& field) {
  if (!std::isfinite(value)) return " is not a finite number";
  if (!field.options().HasExtension(proto::range)) return "";
  const proto::Range& range = field.options().GetExtension(proto::range);
  const bool low = range.has_min() && (range.above() ? value <= range.min() : value < range.min());
  const bool high = range.has_max() && value > range.max();
  if (!low && !high) return "";
  const std::string min = format_number(range.min()) + (range.above() ? " (excluded)" : "");
  if (!range.has_max()) return " is below " + min;
  if (!range.has_min()) return " is above " + format_number(range.max());
  const std::string outside = " is outside " + min + " to " + format_number(range.max());
  constexpr double kDegree = std::numbers::pi / 180.0;
  const bool degrees =
      field.name().ends_with("_rad") && value * kDegree >= range.min() && value * kDegree <= range.max();
  return outside + (degrees ? "; the unit is rad, but this value seems to be in degrees: " +
                                  format_number(value) + " degrees are " + format_number(value * kDegree)
                            : "");
}

std::optional<Violation> find_in_message(const Message& message, FieldPath& path);

/// The start of the text, with each byte that is not printable ASCII as \xNN.
std::string escaped(const std::string& text) {
  constexpr std::size_t kMost = 100;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string result;
  for (const char c : text.substr(0, kMost)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      result += c;
    } else {
      result += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xfU]};
    }
  }
  return text.size() > kMost ? result + "..." : result;
}

std::optional<Violation> find_in_element(const Message& message, FieldPath& path) {
  const PathStep step = path.back();
  if (holds_messages(*step.field)) return find_in_message(message_at(message, step), path);
  if (step.field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    const std::string text = text_at(message, step);
    if (is_utf8(text)) return std::nullopt;
    return Violation{path,
                     " = \"" + escaped(text) + "\" is not UTF-8: save the file, or enter the text, in UTF-8"};
  }
  const auto value = number_at(message, step);
  const std::string broken = value ? broken_range(*value, *step.field) : "";
  if (broken.empty()) return std::nullopt;
  return Violation{path, " = " + format_number(*value) + broken};
}

std::optional<Violation> find_in_field(const Message& message, const FieldDescriptor* field,
                                       FieldPath& path) {
  if (!field->is_repeated()) {
    path.push_back({field, -1});
    auto violation = find_in_element(message, path);
    path.pop_back();
    return violation;
  }
  const int size = message.GetReflection()->FieldSize(message, field);
  const auto count = field->options().GetExtension(proto::count);
  path.push_back({field, -1});
  if (count > 0 && size > 0 && static_cast<unsigned>(size) != count) {
    return Violation{path,
                     " has " + std::to_string(size) + " elements; " + std::to_string(count) + " are needed"};
  }
  for (int i = 0; i < size; ++i) {
    path.back().index = i;
    if (auto violation = find_in_element(message, path)) return violation;
  }
  path.pop_back();
  return std::nullopt;
}

// What came as a number that the schema does not know: the values of closed enums and whole fields end up
// here.
std::optional<Violation> find_unknown(const Message& message, FieldPath path) {
  const auto& unknown = message.GetReflection()->GetUnknownFields(message);
  if (unknown.empty()) return std::nullopt;
  const auto& entry = unknown.field(0);
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByNumber(entry.number());
  const bool is_enum = field != nullptr && field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM &&
                       entry.type() == google::protobuf::UnknownField::TYPE_VARINT;
  if (is_enum) {
    path.push_back({field, -1});
    return Violation{path, " = " + std::to_string(static_cast<std::int64_t>(entry.varint())) +
                               " is not one of " + list_names(enum_names(*field->enum_type()))};
  }
  const std::string number = std::to_string(entry.number());
  return Violation{path, path.empty()
                             ? "field number " + number + " is unknown to this version"
                             : " has the field number " + number + ", which is unknown to this version"};
}

std::optional<Violation> find_in_message(const Message& message, FieldPath& path) {
  if (auto violation = find_unknown(message, path)) return violation;
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (auto violation = find_in_field(message, field, path)) return violation;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Violation> find_violation(const Message& message) {
  FieldPath path;
  return find_in_message(message, path);
}

std::optional<Violation> find_any_violation(const Message& message) {
  if (auto violation = find_violation(message)) return violation;
  return find_inconsistency(message);
}

std::string sentence(const Message& root, const Violation& violation) {
  return path_text(root, violation.path) + violation.text;
}

void validate(const Message& message) {
  if (const auto violation = find_any_violation(message)) throw ConfigError(sentence(message, *violation));
}

}  // namespace longreach
