#include "common/config/ceiling.hpp"

#include <limits>

#include "common/config/differences.hpp"
#include "common/config/field_text.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

proto::Remote remote(const FieldDescriptor& field) { return field.options().GetExtension(proto::remote); }

// Of a limit; the schema has none that is neither a number nor one of a list in order (a test looks).
double number(const Message& message, const FieldDescriptor* field) {
  const auto* reflection = message.GetReflection();
  return field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM ? reflection->GetEnumValue(message, field)
                                                            : reflection->GetDouble(message, field);
}

// The limit that a number stands for; `zero` where 0 is found by the program.
double limit(const Message& message, const FieldDescriptor* field, double zero) {
  const double value = number(message, field);
  return value == 0.0 && field->options().HasExtension(proto::automatic) ? zero : value;
}

double ceiling(const Message& start, const FieldDescriptor* field) {
  return limit(start, field, field->options().GetExtension(proto::automatic));
}

bool allowed(const Message& start, const Message& after, const FieldDescriptor* field) {
  switch (remote(*field)) {
    case proto::FREELY:
      return true;
    case proto::TIGHTER_DOWN:
      return limit(after, field, std::numeric_limits<double>::infinity()) <= ceiling(start, field);
    case proto::TIGHTER_UP:
      return number(after, field) >= ceiling(start, field);
    default:
      return false;
  }
}

std::string ceiling_text(const Message& start, const PathStep& step) {
  if (step.field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM) return value_text(start, step);
  return format_number(ceiling(start, step.field));
}

std::string why(const Message& start, const Message& after, const FieldPath& path) {
  constexpr const char* kInstead = "; change it in the configuration file of this side and restart this side";
  const std::string name = path_text(start, path);
  const FieldDescriptor* field = path.back().field;
  if (holds_messages(*field)) return name + " cannot be changed by a client" + kInstead;
  const std::string text = value_text(holder(start, path), path.back());
  if (remote(*field) == proto::NEVER)
    return name + " cannot be changed by a client: it is " + (text.empty() ? "not set" : text) + kInstead;
  return name + " = " + value_text(holder(after, path), path.back()) + " is less restrictive than " +
         ceiling_text(holder(start, path), path.back()) +
         ", the limit with which this side was started, and a client can only tighten this limit" + kInstead;
}

}  // namespace

std::optional<std::string> beyond_ceiling(const Message& start, const Message& after) {
  for (const auto& [path, change] : differences(start, after)) {
    const bool single = !path.back().field->is_repeated();
    const bool free = remote(*path.back().field) == proto::FREELY;
    if (change == proto::AT_START ||
        !(single ? allowed(holder(start, path), holder(after, path), path.back().field) : free))
      return why(start, after, path);
  }
  return std::nullopt;
}

std::string room_below_ceiling(const Message& start, const PathStep& step) {
  switch (remote(*step.field)) {
    case proto::FREELY:
      return "any value";
    case proto::TIGHTER_DOWN:
      return ceiling_text(start, step) + " or less";
    case proto::TIGHTER_UP:
      return ceiling_text(start, step) + " or more";
    default:
      return "";
  }
}

}  // namespace longreach
