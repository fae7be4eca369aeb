#include "common/config/differences.hpp"

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

proto::Change stricter(proto::Change a, proto::Change b) { return severity(a) < severity(b) ? b : a; }

class Comparison {
 public:
  // `inherited`: what an enclosing field says by its own option; ANY_TIME for nothing.
  void compare(const Message& before, const Message& after, proto::Change inherited) {
    if (before.SerializeAsString() == after.SerializeAsString()) return;
    const auto* type = before.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) compare_field(before, after, type->field(i), inherited);
  }

  std::vector<Difference> found;

 private:
  void compare_field(const Message& before, const Message& after, const FieldDescriptor* field,
                     proto::Change inherited) {
    const proto::Change own = stricter(field->options().GetExtension(proto::change), inherited);
    path_.push_back({field, -1});
    if (!holds_messages(*field)) {
      if (value_text(before, path_.back()) != value_text(after, path_.back())) found.push_back({path_, own});
    } else if (!field->is_repeated()) {
      const bool says_itself = field->options().HasExtension(proto::change);
      compare(message_at(before, path_.back()), message_at(after, path_.back()),
              says_itself ? own : inherited);
    } else {
      compare_elements(before, after, own, field->options().HasExtension(proto::change) ? own : inherited);
    }
    path_.pop_back();
  }

  void compare_elements(const Message& before, const Message& after, proto::Change own,
                        proto::Change inherited) {
    const FieldDescriptor* field = path_.back().field;
    const int size = before.GetReflection()->FieldSize(before, field);
    if (size != after.GetReflection()->FieldSize(after, field)) {
      found.push_back({path_, own});
      return;
    }
    for (int i = 0; i < size; ++i) {
      path_.back().index = i;
      compare(message_at(before, path_.back()), message_at(after, path_.back()), inherited);
    }
    path_.back().index = -1;
  }

  FieldPath path_;
};

}  // namespace

std::vector<Difference> differences(const Message& before, const Message& after) {
  CHECK(before.GetDescriptor() == after.GetDescriptor());
  Comparison comparison;
  comparison.compare(before, after, proto::ANY_TIME);
  return comparison.found;
}

}  // namespace longreach
