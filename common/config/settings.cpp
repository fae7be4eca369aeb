// Single fields by path: setting, printing and comparing them.

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <memory>

#include "common/config/config.hpp"
#include "common/config/field_text.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// The message that holds the last step of `path`.
const Message& holder(const Message& root, const FieldPath& path) {
  const Message* at = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) at = &message_at(*at, path[i]);
  return *at;
}

Message& mutable_holder(Message& root, const FieldPath& path) {
  Message* at = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) at = &mutable_message_at(*at, path[i]);
  return *at;
}

[[noreturn]] void refuse_group(const Message& root, const FieldPath& path) {
  const PathStep& last = path.back();
  const std::string text = path_text(root, path);
  const std::string fields = list_names(field_names(*last.field->message_type()));
  if (last.field->is_repeated() && last.index < 0) {
    throw ConfigError(text + " is a list; set one field of one element, " + text + ".NAME.FIELD or " + text +
                      ".INDEX.FIELD, with FIELD one of: " + fields);
  }
  throw ConfigError(text + " is a group; set one of its fields: " + fields);
}

// `scene` beside `scene_file`: printed empty, it would read as a scene in place and hide the file.
bool is_left_to_file(const Message& message, const FieldDescriptor& field) {
  return !field.is_repeated() && !message.GetReflection()->HasField(message, &field) &&
         message.GetDescriptor()->FindFieldByName(field.name() + "_file") != nullptr;
}

void print_message(const Message& message, const std::string& indent, std::string& out);

void print_nested(const Message& message, const PathStep& step, const std::string& indent, std::string& out) {
  out += indent + step.field->name() + " {\n";
  print_message(message_at(message, step), indent + "  ", out);
  out += indent + "}\n";
}

void print_field(const Message& message, const FieldDescriptor* field, const std::string& indent,
                 std::string& out) {
  const int size = field->is_repeated() ? message.GetReflection()->FieldSize(message, field) : 1;
  if (holds_messages(*field)) {
    if (is_left_to_file(message, *field)) return;
    for (int i = 0; i < size; ++i) print_nested(message, {field, field->is_repeated() ? i : -1}, indent, out);
    return;
  }
  if (size == 0) return;
  std::string value = value_text(message, {field, -1});
  if (field->is_repeated()) value = "[" + value + "]";
  if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    google::protobuf::TextFormat::PrintFieldValueToString(message, field, -1, &value);
  }
  out += indent + field->name() + ": " + value + "\n";
}

void print_message(const Message& message, const std::string& indent, std::string& out) {
  const auto* type = message.GetDescriptor();
  for (int i = 0; i < type->field_count(); ++i) print_field(message, type->field(i), indent, out);
}

}  // namespace

void set_field(Message& message, std::string_view path, std::string_view value) {
  const PathLookup found = find_path(message, path);
  if (!found.error.empty()) throw ConfigError(found.error);
  const FieldDescriptor* field = found.path.back().field;
  if (holds_messages(*field)) refuse_group(message, found.path);

  const std::unique_ptr<Message> changed(message.New());
  changed->CopyFrom(message);
  set_value(mutable_holder(*changed, found.path), *field, value, path_text(message, found.path));
  if (const auto violation = find_violation(*changed)) throw ConfigError(sentence(*changed, *violation));
  message.GetReflection()->Swap(&message, changed.get());
}

std::string get_field(const Message& message, std::string_view path) {
  std::string text;
  if (path.empty()) {
    print_message(message, "", text);
    return text;
  }
  const PathLookup found = find_path(message, path);
  if (!found.error.empty()) throw ConfigError(found.error);
  const PathStep& last = found.path.back();
  const Message& at = holder(message, found.path);
  if (!holds_messages(*last.field)) return value_text(at, last);
  if (last.field->is_repeated() && last.index < 0) {
    print_field(at, last.field, "", text);
  } else {
    print_message(message_at(at, last), "", text);
  }
  return text;
}

}  // namespace longreach
