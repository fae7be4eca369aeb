#include "common/config/parse_error.hpp"

#include <optional>
#include <regex>
#include <set>

#include "common/config/field_path.hpp"

namespace longreach {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;

// Every message type that a file of type `root` can hold.
void collect_types(const Descriptor& root, std::set<const Descriptor*>& types) {
  if (!types.insert(&root).second) return;
  for (int i = 0; i < root.field_count(); ++i) {
    if (holds_messages(*root.field(i))) collect_types(*root.field(i)->message_type(), types);
  }
}

const Descriptor* find_type(const Descriptor& root, const std::string& full_name) {
  std::set<const Descriptor*> types;
  collect_types(root, types);
  for (const Descriptor* type : types) {
    if (type->full_name() == full_name) return type;
  }
  return nullptr;
}

// The enum of all fields of that name, if there is just one: the parser does not say in which message it was.
const EnumDescriptor* find_enum(const Descriptor& root, const std::string& field_name) {
  std::set<const Descriptor*> types;
  collect_types(root, types);
  std::set<const EnumDescriptor*> enums;
  for (const Descriptor* type : types) {
    const auto* field = type->FindFieldByName(field_name);
    if (field != nullptr && field->enum_type() != nullptr) enums.insert(field->enum_type());
  }
  return enums.size() == 1 ? *enums.begin() : nullptr;
}

std::optional<ParseError> unknown_field(const ParseError& said, std::string_view text,
                                        const Descriptor& root) {
  static const std::regex kPattern(R"rx(Message type "([^"]*)" has no field named "([^"]*)"\.)rx");
  std::smatch match;
  if (!std::regex_match(said.text, match, kPattern)) return std::nullopt;
  const std::string word = match[2];
  ParseError error{last_before(text, word, said.position), "unknown field \"" + word + "\""};
  if (const Descriptor* type = find_type(root, match[1])) {
    const Names names = field_names(*type);
    error.text += " in " + type->name() + did_you_mean(word, names);
    if (!nearest_name(word, names)) error.text += "; it has: " + list_names(names);
  }
  return error;
}

std::optional<ParseError> unknown_enum_value(const ParseError& said, std::string_view text,
                                             const Descriptor& root) {
  static const std::regex kPattern(R"rx(Unknown enumeration value of "([^"]*)" for field "([^"]*)"\.)rx");
  std::smatch match;
  if (!std::regex_match(said.text, match, kPattern)) return std::nullopt;
  const std::string word = match[1];
  const std::string field = match[2];
  ParseError error{last_before(text, word, said.position), field + " = " + word + " is not a known value"};
  if (const EnumDescriptor* type = find_enum(root, field)) {
    error.text = field + " = " + word + " is not one of " + list_names(enum_names(*type));
  }
  return error;
}

}  // namespace

ParseError reword(const ParseError& said, std::string_view text, const Descriptor& root) {
  if (auto error = unknown_field(said, text, root)) return *error;
  if (auto error = unknown_enum_value(said, text, root)) return *error;
  ParseError error = said;
  if (error.text.starts_with("Interpreting non ascii codepoint"))
    error.text =
        "there is a non-ASCII character outside quotes; only quoted text may contain such "
        "characters";
  if (error.text.ends_with("got: ")) error.text += "the end of the file";
  if (error.text.ends_with('.')) error.text.pop_back();
  return error;
}

}  // namespace longreach
