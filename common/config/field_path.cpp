#include "common/config/field_path.hpp"

#include <optional>

#include "common/text/number_text.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const auto dot = text.find('.');
    words.push_back(text.substr(0, dot));
    if (dot == std::string_view::npos) return words;
    text.remove_prefix(dot + 1);
  }
}

std::string quoted(std::string_view text) { return std::string("\"").append(text).append("\""); }

Names element_names(const Message& parent, const FieldDescriptor* field) {
  Names names;
  const int size = parent.GetReflection()->FieldSize(parent, field);
  for (int i = 0; i < size; ++i) {
    const std::string name = name_of(message_at(parent, {field, i}));
    names.push_back(name.empty() ? std::to_string(i) : name);
  }
  return names;
}

// By index where the word is a number, else the first of that name.
std::optional<int> find_element(const Message& parent, const FieldDescriptor* field, std::string_view word) {
  const int size = parent.GetReflection()->FieldSize(parent, field);
  if (const auto index = parse_integer<int>(word)) {
    return *index >= 0 && *index < size ? index : std::nullopt;
  }
  for (int i = 0; i < size && !word.empty(); ++i) {
    if (name_of(message_at(parent, {field, i})) == word) return i;
  }
  return std::nullopt;
}

std::string no_such_field(const Message& root, const PathLookup& found, const Message& at,
                          std::string_view word) {
  const Names names = field_names(*at.GetDescriptor());
  const std::string where = path_text(root, found.path);
  return (where.empty() ? "there is no field " : where + " has no field ") + quoted(word) +
         instead_of(word, names, where.empty() ? "the fields are" : "it has");
}

std::string no_such_element(const Message& root, const PathLookup& found, const Names& names,
                            std::string_view word) {
  return path_text(root, found.path) + " has no element " + quoted(word) + instead_of(word, names, "it has");
}

}  // namespace

bool holds_messages(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

Names field_names(const google::protobuf::Descriptor& type) {
  Names names;
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

Names enum_names(const google::protobuf::EnumDescriptor& type) {
  Names names;
  for (int i = 0; i < type.value_count(); ++i) names.push_back(type.value(i)->name());
  return names;
}

const Message& message_at(const Message& parent, const PathStep& step) {
  const auto* reflection = parent.GetReflection();
  if (step.field->is_repeated()) return reflection->GetRepeatedMessage(parent, step.field, step.index);
  return reflection->GetMessage(parent, step.field);
}

const Message& holder(const Message& root, const FieldPath& path) {
  const Message* at = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) at = &message_at(*at, path[i]);
  return *at;
}

Message& mutable_message_at(Message& parent, const PathStep& step) {
  const auto* reflection = parent.GetReflection();
  if (step.field->is_repeated()) return *reflection->MutableRepeatedMessage(&parent, step.field, step.index);
  return *reflection->MutableMessage(&parent, step.field);
}

std::string name_of(const Message& message) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName("name");
  if (field == nullptr || field->is_repeated() || field->cpp_type() != FieldDescriptor::CPPTYPE_STRING)
    return "";
  return message.GetReflection()->GetString(message, field);
}

std::string path_text(const Message& root, const FieldPath& path) {
  std::string text;
  const Message* at = &root;
  for (const PathStep& step : path) {
    text += (text.empty() ? "" : ".") + step.field->name();
    if (step.index >= 0) {
      const std::string name = holds_messages(*step.field) ? name_of(message_at(*at, step)) : "";
      const bool leads_back = !name.empty() && find_element(*at, step.field, name) == step.index;
      text += "." + (leads_back ? name : std::to_string(step.index));
    }
    const bool whole_list = step.field->is_repeated() && step.index < 0;
    if (holds_messages(*step.field) && !whole_list) at = &message_at(*at, step);
  }
  return text;
}

PathLookup find_path(const Message& root, std::string_view text) {
  PathLookup found;
  const Message* at = &root;
  const std::vector<std::string_view> words = split(text);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const FieldDescriptor* field = at->GetDescriptor()->FindFieldByName(std::string(words[i]));
    if (field == nullptr) {
      found.error = no_such_field(root, found, *at, words[i]);
      return found;
    }
    found.path.push_back({field, -1});
    if (i + 1 == words.size()) return found;
    if (!holds_messages(*field)) {
      found.error =
          path_text(root, found.path) + " is a single value and has no field " + quoted(words[i + 1]);
      return found;
    }
    if (field->is_repeated()) {
      const auto index = find_element(*at, field, words[++i]);
      if (!index) {
        found.error = no_such_element(root, found, element_names(*at, field), words[i]);
        return found;
      }
      found.path.back().index = *index;
    }
    at = &message_at(*at, found.path.back());
  }
  return found;
}

}  // namespace longreach
