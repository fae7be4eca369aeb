#pragma once
// Plain structs from messages, and back, over visit_fields() of the structs (proto/structs.cpp). The enums of structs have
// the numbers of those of the schema.

#include <google/protobuf/message.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/core/check.hpp"
#include "common/core/time.hpp"
#include "common/link/hold_cause.hpp"
#include "common/messages/spatial_fields.hpp"
#include "common/schema/visit.hpp"

namespace longreach {

template <class E>
concept Enum = std::is_enum_v<E>;
template <class S>
concept Section = std::is_class_v<S>;

/// Finds the fields of a message by name. Visitors ask in the order of the schema, so that the next one is nearly always
/// the field that is sought.
class FieldCursor {
 public:
  explicit FieldCursor(const google::protobuf::Message& message) : type_(*message.GetDescriptor()) {}

  const google::protobuf::FieldDescriptor* find(std::string_view name) {
    for (const int i : {next_, next_ - 1})
      if (i >= 0 && i < type_.field_count() && type_.field(i)->name() == name) return at(i);
    const auto* field = type_.FindFieldByName(std::string(name));
    CHECK(field != nullptr);
    return at(field->index());
  }

 private:
  const google::protobuf::FieldDescriptor* at(int i) {
    next_ = i + 1;
    return type_.field(i);
  }

  const google::protobuf::Descriptor& type_;
  int next_ = 0;
};

/// Message to struct. A field that is not set gives the schema's default.
class MessageReader {
 public:
  explicit MessageReader(const google::protobuf::Message& message)
      : message_(message), reflection_(*message.GetReflection()), fields_(message) {}

  void operator()(const char* name, double& v) { v = reflection_.GetDouble(message_, fields_.find(name)); }
  void operator()(const char* name, bool& v) { v = reflection_.GetBool(message_, fields_.find(name)); }
  void operator()(const char* name, std::string& v) {
    v = reflection_.GetString(message_, fields_.find(name));
  }
  void operator()(const char* name, int& v) { v = reflection_.GetInt32(message_, fields_.find(name)); }
  void operator()(const char* name, std::uint32_t& v) {
    v = reflection_.GetUInt32(message_, fields_.find(name));
  }
  void operator()(const char* name, std::uint64_t& v) {
    v = reflection_.GetUInt64(message_, fields_.find(name));
  }
  void operator()(const char* name, Time& v) {
    v = Time(Duration(reflection_.GetInt64(message_, fields_.find(name))));
  }
  /// Throws std::out_of_range if the number is not one of the enum's.
  void operator()(const char* name, Enum auto& v) {
    using E = std::remove_reference_t<decltype(v)>;
    const int number = reflection_.GetEnumValue(message_, fields_.find(name));
    if (number < 0 || number >= kCountOf<E>)
      throw std::out_of_range(std::string(name) + ": the value " + std::to_string(number) + " is unknown");
    v = static_cast<E>(number);
  }
  /// A cause is an enum in one field and its details a message in another one, or both are one message.
  void operator()(const char* name, Reason& v) {
    const auto* field = fields_.find(name);
    if (field->enum_type() != nullptr) return (*this)(name, v.cause);
    MessageReader place(reflection_.GetMessage(message_, field));
    if (field->message_type()->FindFieldByName("cause") != nullptr) place("cause", v.cause);
    std::uint32_t joint = 0;
    place("joint", joint);
    v.joint = static_cast<std::uint8_t>(joint);
    place("value", v.value);
    place("limit", v.limit);
  }
  void operator()(const char* name, Section auto& v) {
    MessageReader reader(reflection_.GetMessage(message_, fields_.find(name)));
    visit_fields(reader, v);
  }
  template <class T>
  void operator()(const char* name, std::optional<T>& v) {
    if (reflection_.HasField(message_, fields_.find(name))) (*this)(name, v.emplace());
  }
  // Three numbers, or a message. Without numbers, the struct keeps its default.
  void operator()(const char* name, Vector3& v) {
    const auto* field = fields_.find(name);
    if (!field->is_repeated()) {
      MessageReader reader(reflection_.GetMessage(message_, field));
      visit_fields(reader, v);
    } else if (reflection_.FieldSize(message_, field) == 3) {
      for (int i = 0; i < 3; ++i) v[i] = reflection_.GetRepeatedDouble(message_, field, i);
    }
  }
  void operator()(const char* name, std::vector<double>& v) {
    const auto* field = fields_.find(name);
    v.clear();
    for (int i = 0; i < reflection_.FieldSize(message_, field); ++i)
      v.push_back(reflection_.GetRepeatedDouble(message_, field, i));
  }
  template <Section S, std::size_t N>
  void operator()(const char* name, std::array<S, N>& v) {
    const auto* field = fields_.find(name);
    const int size = std::min(reflection_.FieldSize(message_, field), static_cast<int>(N));
    for (int i = 0; i < size; ++i) read_element(field, i, v[static_cast<std::size_t>(i)]);
  }
  template <Section S>
  void operator()(const char* name, std::vector<S>& v) {
    const auto* field = fields_.find(name);
    v.resize(static_cast<std::size_t>(reflection_.FieldSize(message_, field)));
    for (std::size_t i = 0; i < v.size(); ++i) read_element(field, static_cast<int>(i), v[i]);
  }

 private:
  void read_element(const google::protobuf::FieldDescriptor* field, int i, Section auto& v) {
    MessageReader reader(reflection_.GetRepeatedMessage(message_, field, i));
    visit_fields(reader, v);
  }

  const google::protobuf::Message& message_;
  const google::protobuf::Reflection& reflection_;
  FieldCursor fields_;
};

/// Struct to message. Every field is set, but for empty optional ones.
class MessageWriter {
 public:
  explicit MessageWriter(google::protobuf::Message& message)
      : message_(message), reflection_(*message.GetReflection()), fields_(message) {}

  void operator()(const char* name, double v) { reflection_.SetDouble(&message_, fields_.find(name), v); }
  void operator()(const char* name, bool v) { reflection_.SetBool(&message_, fields_.find(name), v); }
  void operator()(const char* name, const std::string& v) {
    reflection_.SetString(&message_, fields_.find(name), v);
  }
  void operator()(const char* name, int v) { reflection_.SetInt32(&message_, fields_.find(name), v); }
  void operator()(const char* name, std::uint32_t v) {
    reflection_.SetUInt32(&message_, fields_.find(name), v);
  }
  void operator()(const char* name, std::uint64_t v) {
    reflection_.SetUInt64(&message_, fields_.find(name), v);
  }
  void operator()(const char* name, const Time& v) {
    reflection_.SetInt64(&message_, fields_.find(name), v.time_since_epoch().count());
  }
  void operator()(const char* name, Enum auto v) {
    reflection_.SetEnumValue(&message_, fields_.find(name), static_cast<int>(v));
  }
  void operator()(const char* name, const Reason& v) {
    const auto* field = fields_.find(name);
    if (field->enum_type() != nullptr) return (*this)(name, v.cause);
    MessageWriter place(*reflection_.MutableMessage(&message_, field));
    if (field->message_type()->FindFieldByName("cause") != nullptr) place("cause", v.cause);
    place("joint", static_cast<std::uint32_t>(v.joint));
    place("value", v.value);
    place("limit", v.limit);
  }
  void operator()(const char* name, const Section auto& v) {
    MessageWriter writer(*reflection_.MutableMessage(&message_, fields_.find(name)));
    visit_fields(writer, v);
  }
  template <class T>
  void operator()(const char* name, const std::optional<T>& v) {
    if (v) (*this)(name, *v);
  }
  void operator()(const char* name, const Vector3& v) {
    const auto* field = fields_.find(name);
    if (!field->is_repeated()) {
      MessageWriter writer(*reflection_.MutableMessage(&message_, field));
      visit_fields(writer, v);
      return;
    }
    for (int i = 0; i < 3; ++i) reflection_.AddDouble(&message_, field, v[i]);
  }
  void operator()(const char* name, const std::vector<double>& v) {
    const auto* field = fields_.find(name);
    for (const double number : v) reflection_.AddDouble(&message_, field, number);
  }
  template <Section S, std::size_t N>
  void operator()(const char* name, const std::array<S, N>& v) {
    const auto* field = fields_.find(name);
    for (const S& element : v) add_element(field, element);
  }
  template <Section S>
  void operator()(const char* name, const std::vector<S>& v) {
    const auto* field = fields_.find(name);
    for (const S& element : v) add_element(field, element);
  }

 private:
  void add_element(const google::protobuf::FieldDescriptor* field, const Section auto& v) {
    MessageWriter writer(*reflection_.AddMessage(&message_, field));
    visit_fields(writer, v);
  }

  google::protobuf::Message& message_;
  const google::protobuf::Reflection& reflection_;
  FieldCursor fields_;
};

template <class S>
S from_message(const google::protobuf::Message& message) {
  S value;
  MessageReader reader(message);
  visit_fields(reader, value);
  return value;
}

/// Adds the fields of `value` to an empty message.
template <class S>
void to_message(const S& value, google::protobuf::Message& message) {
  MessageWriter writer(message);
  visit_fields(writer, value);
}

/// As to_message(), with the fields that are displayed and not recorded.
template <class S>
void to_shown_message(const S& value, google::protobuf::Message& message) {
  MessageWriter writer(message);
  visit_fields(writer, value);
  visit_shown(writer, value);
}

}  // namespace longreach
