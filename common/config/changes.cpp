// What may not change now.

#include "common/config/config.hpp"
#include "common/config/field_text.hpp"
#include "common/core/check.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Stricter is greater. A part of something that is read at start is read at start.
int severity(proto::Change change) {
  switch (change) {
    case proto::ANY_TIME:
      return 0;
    case proto::NOT_WHILE_ENGAGED:
      return 1;
    case proto::AT_START:
      return 2;
  }
  return 2;
}

class Comparison {
 public:
  Comparison(const Message& before, bool engaged) : root_(before), allowed_(engaged ? 0 : 1) {}

  // `inherited`: severity that an enclosing field has by its own option; 0 for none.
  void compare(const Message& before, const Message& after, int inherited) {
    const auto* type = before.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) compare_field(before, after, type->field(i), inherited);
  }

  std::vector<std::string> refused;

 private:
  void compare_field(const Message& before, const Message& after, const FieldDescriptor* field,
                     int inherited) {
    const int own = severity(field->options().GetExtension(proto::change));
    path_.push_back({field, -1});
    if (!holds_messages(*field)) {
      if (value_text(before, path_.back()) != value_text(after, path_.back())) book(std::max(own, inherited));
    } else {
      const bool says_itself = field->options().HasExtension(proto::change);
      compare_messages(before, after, field, says_itself ? std::max(own, inherited) : inherited);
    }
    path_.pop_back();
  }

  void compare_messages(const Message& before, const Message& after, const FieldDescriptor* field,
                        int inherited) {
    if (!field->is_repeated()) {
      return compare(message_at(before, {field, -1}), message_at(after, {field, -1}), inherited);
    }
    const int size = before.GetReflection()->FieldSize(before, field);
    if (size != after.GetReflection()->FieldSize(after, field)) {
      return book(std::max(severity(field->options().GetExtension(proto::change)), inherited));
    }
    for (int i = 0; i < size; ++i) {
      path_.back().index = i;
      compare(message_at(before, {field, i}), message_at(after, {field, i}), inherited);
    }
    path_.back().index = -1;
  }

  void book(int severity) {
    if (severity > allowed_) refused.push_back(path_text(root_, path_));
  }

  const Message& root_;
  int allowed_;
  FieldPath path_;
};

}  // namespace

std::vector<std::string> refused_changes(const Message& before, const Message& after, bool engaged) {
  CHECK(before.GetDescriptor() == after.GetDescriptor());
  Comparison comparison(before, engaged);
  comparison.compare(before, after, 0);
  return comparison.refused;
}

}  // namespace longreach
