// Single fields by path: setting, printing and comparing them.

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "common/config/ceiling.hpp"
#include "common/config/config.hpp"
#include "common/config/field_text.hpp"
#include "common/config/origins.hpp"
#include "common/config/set_fields.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

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
    throw ConfigError(text + " is a list; set a field of one of its elements, " + text + ".NAME.FIELD or " +
                      text + ".INDEX.FIELD, where FIELD is one of: " + fields);
  }
  throw ConfigError(text + " is a group; set one of its fields: " + fields);
}

// `scene` beside `scene_file`, `robot` beside `robot_file`: what it does not say is not there, and there may
// be no more than one kind of shape. Printed empty, it would read as one. What a device does not say has
// defaults.
bool is_of_file(const FieldDescriptor& field) {
  return field.name() != "device" &&
         field.containing_type()->FindFieldByName(field.name() + "_file") != nullptr;
}

// Limits for all joints and the links of a URDF: if they are not set, the joints have values of their own.
bool is_of_joints(const FieldDescriptor& field) {
  constexpr std::array kNames{"base_link", "tip_link", "acceleration_max_rad_per_s2", "jerk_max_rad_per_s3"};
  return field.containing_type() == proto::Robot::descriptor() &&
         std::ranges::find(kNames, field.name()) != kNames.end();
}

/// Prints fields with their defaults where they are not set; of what a file describes only what is there.
/// `start`, the same part of what the side was started with: what clients may set is noted. None: it is not.
/// `origins`, of the root: where each value comes from is noted. None: it is not.
struct Printer {
  bool of_file = false;
  const Origins* origins = nullptr;
  std::string place{};  // path of the message that is printed, with a point behind it
  std::string text{};

  void message(const Message& message, const Message* start, const std::string& indent) {
    const auto* type = message.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) field(message, start, type->field(i), indent);
  }

  void field(const Message& message, const Message* start, const FieldDescriptor* field,
             const std::string& indent) {
    if (field->options().GetExtension(proto::change) == proto::AT_START) start = nullptr;
    if (holds_messages(*field)) return nested(message, start, field, indent);
    if (field->is_repeated() && message.GetReflection()->FieldSize(message, field) == 0) return;
    if (is_of_joints(*field) && !message.GetReflection()->HasField(message, field)) return;
    std::string value = value_text(message, {field, -1});
    if (field->is_repeated()) value = "[" + value + "]";
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      google::protobuf::TextFormat::PrintFieldValueToString(message, field, -1, &value);
    }
    text += indent + field->name() + ": " + value + comment(start, field) + "\n";
  }

 private:
  std::string comment(const Message* start, const FieldDescriptor* field) const {
    std::string comment = origins == nullptr ? "" : origins->of(place + field->name());
    const std::string room = start != nullptr ? room_below_ceiling(*start, {field, -1}) : "";
    if (!room.empty()) comment += (comment.empty() ? "" : "; ") + ("may be set: " + room);
    return comment.empty() ? "" : "  # " + comment;
  }

  void nested(const Message& message, const Message* start, const FieldDescriptor* field,
              const std::string& indent) {
    const Reflection* reflection = message.GetReflection();
    const bool outside = of_file;
    const std::string before = place;
    of_file = of_file || is_of_file(*field);
    const bool there = field->is_repeated() || !of_file || reflection->HasField(message, field);
    const int size = field->is_repeated() ? reflection->FieldSize(message, field) : 1;
    if (field->is_repeated()) start = nullptr;  // clients change no lists
    for (int i = 0; there && i < size; ++i) {
      const PathStep step{field, field->is_repeated() ? i : -1};
      place = before + field->name() + (field->is_repeated() ? "." + std::to_string(i) : "") + ".";
      text += indent + field->name() + " {\n";
      this->message(message_at(message, step), start == nullptr ? nullptr : &message_at(*start, step),
                    indent + "  ");
      text += indent + "}\n";
    }
    of_file = outside;
    place = before;
  }
};

// The part of `start` that a path leads to; none where nothing in it may be set.
const Message* part_at(const Message* start, const FieldPath& path) {
  for (const PathStep& step : path) {
    if (start == nullptr || step.field->is_repeated() ||
        step.field->options().GetExtension(proto::change) == proto::AT_START)
      return nullptr;
    start = &message_at(*start, step);
  }
  return start;
}

void assign(Message& message, std::string_view path, std::string_view value) {
  const PathLookup found = find_path(message, path);
  if (!found.error.empty()) throw ConfigError(found.error);
  const FieldDescriptor* field = found.path.back().field;
  if (holds_messages(*field)) refuse_group(message, found.path);
  set_value(mutable_holder(message, found.path), *field, value, path_text(message, found.path));
}

std::string text_of(const Message& message, std::string_view path, const Message* start,
                    const Origins* origins) {
  Printer print{.origins = origins};
  if (path.empty()) {
    print.message(message, start, "");
    return print.text;
  }
  const PathLookup found = find_path(message, path);
  if (!found.error.empty()) throw ConfigError(found.error);
  const PathStep& last = found.path.back();
  const Message& at = holder(message, found.path);
  if (!holds_messages(*last.field))
    return value_text(at, last) + (origins == nullptr ? "" : "  # " + origins->of(path_by_index(found.path)));
  print.of_file =
      std::ranges::any_of(found.path, [](const PathStep& step) { return is_of_file(*step.field); });
  if (last.field->is_repeated() && last.index < 0) {
    const FieldPath above(found.path.begin(), found.path.end() - 1);
    print.place = above.empty() ? "" : path_by_index(above) + ".";
    print.field(at, nullptr, last.field, "");
  } else {
    print.place = path_by_index(found.path) + ".";
    print.message(message_at(at, last), part_at(start, found.path), "");
  }
  return print.text;
}

}  // namespace

void set_field(Message& message, std::string_view path, std::string_view value) {
  const std::unique_ptr<Message> changed(message.New());
  changed->CopyFrom(message);
  assign(*changed, path, value);
  if (const auto violation = find_violation(*changed)) throw ConfigError(sentence(*changed, *violation));
  message.GetReflection()->Swap(&message, changed.get());
}

void set_fields(Message& message, const std::vector<std::pair<std::string, std::string>>& assignments) {
  const std::unique_ptr<Message> changed(message.New());
  changed->CopyFrom(message);
  for (const auto& [path, value] : assignments) assign(*changed, path, value);
  validate(*changed);
  message.GetReflection()->Swap(&message, changed.get());
}

std::string get_field(const Message& message, std::string_view path, const Message* start) {
  return text_of(message, path, start, nullptr);
}

std::string get_field_with_origins(const Message& message, std::string_view path, const Message* start,
                                   const Origins& origins) {
  return text_of(message, path, start, &origins);
}

}  // namespace longreach
