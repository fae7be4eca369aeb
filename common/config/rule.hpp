#pragma once
// Helpers for the rules in consistency.cpp and robot_rules.cpp.

#include <optional>
#include <string>
#include <utility>

#include "common/config/violation.hpp"
#include "common/text/number_text.hpp"

namespace longreach {

using Finding = std::optional<Violation>;
using google::protobuf::Message;

// Returns a violation at a field of `message`; the path starts at `message`.
inline Violation at(const Message& message, const char* field, std::string text) {
  return {{{message.GetDescriptor()->FindFieldByName(field), -1}}, std::move(text)};
}

inline Violation at_element(const Message& message, const char* list, int index, const char* field,
                            std::string text) {
  const PathStep element{message.GetDescriptor()->FindFieldByName(list), index};
  return {{element, {element.field->message_type()->FindFieldByName(field), -1}}, std::move(text)};
}

struct Named {
  const char* name;
  double value;
};

// Returns none if `low` < `high`; otherwise a violation at `high` if only that field is set, or else at
// `low`.
inline Finding in_order(const Message& message, const Named& low, const Named& high) {
  if (low.value < high.value) return std::nullopt;
  const auto* high_field = message.GetDescriptor()->FindFieldByName(high.name);
  const auto* low_field = message.GetDescriptor()->FindFieldByName(low.name);
  const auto* reflection = message.GetReflection();
  if (!reflection->HasField(message, low_field) && reflection->HasField(message, high_field)) {
    return at(
        message, high.name,
        " = " + format_number(high.value) + " is not above " + low.name + " = " + format_number(low.value));
  }
  return at(
      message, low.name,
      " = " + format_number(low.value) + " is not below " + high.name + " = " + format_number(high.value));
}

}  // namespace longreach
