#pragma once
// Visits all fields of a message by reflection, so that tests cannot miss a field.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <set>
#include <string>
#include <vector>

#include "common/config/field_path.hpp"

namespace longreach {

/// Sets every leaf field to a valid value other than its default; all numbers are different. Lists get the
/// number of elements that the schema requires, or two elements by default.
class DistinctValues {
 public:
  void fill(google::protobuf::Message& message) {
    const auto* type = message.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i) fill_field(message, type->field(i));
  }

 private:
  using Field = google::protobuf::FieldDescriptor;

  void fill_field(google::protobuf::Message& message, const Field* field) {
    const auto* reflection = message.GetReflection();
    const auto count = field->options().GetExtension(proto::count);
    const int size = !field->is_repeated() ? 1 : count > 0 ? static_cast<int>(count) : 2;
    for (int i = 0; i < size; ++i) {
      if (field->message_type() != nullptr) {
        fill(field->is_repeated() ? *reflection->AddMessage(&message, field)
                                  : *reflection->MutableMessage(&message, field));
      } else if (field->is_repeated()) {
        reflection->AddDouble(&message, field, 0.001 * ++number_);
      } else {
        set(message, field);
      }
    }
  }

  void set(google::protobuf::Message& message, const Field* field) {
    const auto* reflection = message.GetReflection();
    const proto::Range& range = field->options().GetExtension(proto::range);
    switch (field->cpp_type()) {
      case Field::CPPTYPE_DOUBLE:
        return reflection->SetDouble(&message, field, number_within(range, field->default_value_double()));
      case Field::CPPTYPE_UINT32:
        return reflection->SetUInt32(&message, field, field->default_value_uint32() + 1);
      case Field::CPPTYPE_BOOL:
        return reflection->SetBool(&message, field, !field->default_value_bool());
      case Field::CPPTYPE_ENUM: {
        const auto* type = field->enum_type();
        const int next = (field->default_value_enum()->index() + 1) % type->value_count();
        return reflection->SetEnumValue(&message, field, type->value(next)->number());
      }
      default:
        reflection->SetString(&message, field, "text" + std::to_string(++number_));
    }
  }

  double number_within(const proto::Range& range, double avoid) {
    double value = avoid;
    while (value == avoid || !seen_.insert(value).second) {
      const double share = 0.05 + 0.9 * (++number_ % 1009) / 1009.0;
      value = range.min() + share * (range.max() - range.min());
    }
    return value;
  }

  int number_ = 0;
  std::set<double> seen_;
};

inline void fill_distinct(google::protobuf::Message& message) { DistinctValues().fill(message); }

template <class M>
M distinct() {
  M message;
  fill_distinct(message);
  return message;
}

inline void add_leaf_paths(const google::protobuf::Message& root, const google::protobuf::Message& at,
                           FieldPath& path, std::vector<std::string>& paths) {
  const auto* type = at.GetDescriptor();
  for (int i = 0; i < type->field_count(); ++i) {
    const auto* field = type->field(i);
    path.push_back({field, -1});
    if (field->message_type() == nullptr) {
      paths.push_back(path_text(root, path));
    } else {
      const int size = field->is_repeated() ? at.GetReflection()->FieldSize(at, field) : 1;
      for (int k = 0; k < size; ++k) {
        path.back().index = field->is_repeated() ? k : -1;
        add_leaf_paths(root, message_at(at, path.back()), path, paths);
      }
    }
    path.pop_back();
  }
}

/// Returns the paths of all leaf fields of `message`, whether set or not.
inline std::vector<std::string> leaf_paths(const google::protobuf::Message& message) {
  FieldPath path;
  std::vector<std::string> paths;
  add_leaf_paths(message, message, path, paths);
  return paths;
}

}  // namespace longreach
