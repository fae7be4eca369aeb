#include "common/config/origins.hpp"

#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "common/config/differences.hpp"
#include "common/config/field_path.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

bool inside(std::string_view path, std::string_view field) {
  return field.starts_with(path) &&
         (field.size() == path.size() || path.empty() || field[path.size()] == '.');
}

void add_set_paths(const Message& message, const std::string& before, std::vector<std::string>& paths) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const std::string path = before + field->name();
    if (!holds_messages(*field)) {
      paths.push_back(path);
      continue;
    }
    const int size = field->is_repeated() ? message.GetReflection()->FieldSize(message, field) : 1;
    for (int i = 0; i < size; ++i) {
      const PathStep step{field, field->is_repeated() ? i : -1};
      add_set_paths(message_at(message, step),
                    path + (field->is_repeated() ? "." + std::to_string(i) : "") + ".", paths);
    }
  }
}

bool of_person(const std::string& origin) {
  return origin == kFromCommandLine || origin.starts_with(kFromConfigFile);
}

}  // namespace

std::string path_by_index(const FieldPath& path) {
  std::string text;
  for (const PathStep& step : path) {
    text += (text.empty() ? "" : ".") + step.field->name();
    if (step.index >= 0 && holds_messages(*step.field)) text += "." + std::to_string(step.index);
  }
  return text;
}

std::vector<std::string> set_paths(const Message& message) {
  std::vector<std::string> paths;
  add_set_paths(message, "", paths);
  return paths;
}

void Origins::add(const Message& message, const std::string& origin) {
  for (std::string& path : set_paths(message)) by_path_.emplace(std::move(path), origin);
}

void Origins::replace(const Message& message, std::string_view path, const std::string& origin) {
  const PathLookup found = find_path(message, path);
  if (!found.error.empty()) return;
  const std::string field = path_by_index(found.path);
  forget(field);
  if (!holds_messages(*found.path.back().field)) {
    by_path_[field] = origin;
    return;
  }
  for (std::string& set : set_paths(message)) {
    if (inside(field, set)) by_path_[std::move(set)] = origin;
  }
}

void Origins::forget(std::string_view path) {
  std::erase_if(by_path_, [path](const auto& entry) { return inside(path, entry.first); });
}

const std::string& Origins::of(const std::string& path) const {
  static const std::string kDefault = "default";
  const auto found = by_path_.find(path);
  return found == by_path_.end() ? kDefault : found->second;
}

bool Origins::set_by_person(std::string_view path) const {
  return std::ranges::any_of(
      by_path_, [path](const auto& entry) { return inside(path, entry.first) && of_person(entry.second); });
}

std::vector<std::string> Origins::set_by_person() const {
  std::vector<std::string> paths;
  for (const auto& [path, origin] : by_path_) {
    if (of_person(origin)) paths.push_back(path);
  }
  return paths;
}

Origins with_clients(Origins origins, const Message& start, const Message& present) {
  for (const Difference& difference : differences(start, present))
    origins.replace(present, path_by_index(difference.path), "client");
  return origins;
}

}  // namespace longreach
