// Plain structs from messages, and back, over visit_fields() of the structs (proto/structs.cpp). The enums of structs
// have the numbers of those of the schema.

#include <google/protobuf/message.h>

#include <array>
#include <optional>
#include <vector>

#include "common/config/config.hpp"
#include "common/core/check.hpp"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

template <class E>
concept Enum = std::is_enum_v<E>;

template <class S>
concept Section = std::is_class_v<S> && !std::same_as<S, std::string> && !std::same_as<S, Vector3>;

const FieldDescriptor* field_of(const Message& message, const char* name) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(name);
  CHECK(field != nullptr);
  return field;
}

// Message to struct. A field that is not set gives the schema's default.
class Reader {
 public:
  explicit Reader(const Message& message) : message_(message), reflection_(*message.GetReflection()) {}

  void operator()(const char* name, double& v) {
    v = reflection_.GetDouble(message_, field_of(message_, name));
  }
  void operator()(const char* name, bool& v) { v = reflection_.GetBool(message_, field_of(message_, name)); }
  void operator()(const char* name, std::string& v) {
    v = reflection_.GetString(message_, field_of(message_, name));
  }
  void operator()(const char* name, std::uint32_t& v) {
    v = reflection_.GetUInt32(message_, field_of(message_, name));
  }
  void operator()(const char* name, Enum auto& v) {
    v = static_cast<std::remove_reference_t<decltype(v)>>(
        reflection_.GetEnumValue(message_, field_of(message_, name)));
  }
  void operator()(const char* name, Section auto& v) {
    Reader reader(reflection_.GetMessage(message_, field_of(message_, name)));
    visit_fields(reader, v);
  }
  template <Section S>
  void operator()(const char* name, std::optional<S>& v) {
    if (reflection_.HasField(message_, field_of(message_, name))) (*this)(name, v.emplace());
  }
  // Absent: the struct keeps its default.
  void operator()(const char* name, Vector3& v) {
    const FieldDescriptor* field = field_of(message_, name);
    if (reflection_.FieldSize(message_, field) != 3) return;
    for (int i = 0; i < 3; ++i) v[i] = reflection_.GetRepeatedDouble(message_, field, i);
  }
  void operator()(const char* name, std::vector<double>& v) {
    const FieldDescriptor* field = field_of(message_, name);
    v.clear();
    for (int i = 0; i < reflection_.FieldSize(message_, field); ++i)
      v.push_back(reflection_.GetRepeatedDouble(message_, field, i));
  }
  template <Section S, std::size_t N>
  void operator()(const char* name, std::array<S, N>& v) {
    const FieldDescriptor* field = field_of(message_, name);
    const int size = std::min(reflection_.FieldSize(message_, field), static_cast<int>(N));
    for (int i = 0; i < size; ++i) read_element(field, i, v[static_cast<std::size_t>(i)]);
  }
  template <Section S>
  void operator()(const char* name, std::vector<S>& v) {
    const FieldDescriptor* field = field_of(message_, name);
    v.resize(static_cast<std::size_t>(reflection_.FieldSize(message_, field)));
    for (std::size_t i = 0; i < v.size(); ++i) read_element(field, static_cast<int>(i), v[i]);
  }

 private:
  void read_element(const FieldDescriptor* field, int i, Section auto& v) {
    Reader reader(reflection_.GetRepeatedMessage(message_, field, i));
    visit_fields(reader, v);
  }

  const Message& message_;
  const Reflection& reflection_;
};

// Struct to message. Every field is set.
class Writer {
 public:
  explicit Writer(Message& message) : message_(message), reflection_(*message.GetReflection()) {}

  void operator()(const char* name, double v) {
    reflection_.SetDouble(&message_, field_of(message_, name), v);
  }
  void operator()(const char* name, bool v) { reflection_.SetBool(&message_, field_of(message_, name), v); }
  void operator()(const char* name, const std::string& v) {
    reflection_.SetString(&message_, field_of(message_, name), v);
  }
  void operator()(const char* name, std::uint32_t v) {
    reflection_.SetUInt32(&message_, field_of(message_, name), v);
  }
  void operator()(const char* name, Enum auto v) {
    reflection_.SetEnumValue(&message_, field_of(message_, name), static_cast<int>(v));
  }
  void operator()(const char* name, const Section auto& v) {
    Writer writer(*reflection_.MutableMessage(&message_, field_of(message_, name)));
    visit_fields(writer, v);
  }
  template <Section S>
  void operator()(const char* name, const std::optional<S>& v) {
    if (v) (*this)(name, *v);
  }
  void operator()(const char* name, const Vector3& v) {
    for (int i = 0; i < 3; ++i) reflection_.AddDouble(&message_, field_of(message_, name), v[i]);
  }
  void operator()(const char* name, const std::vector<double>& v) {
    for (const double number : v) reflection_.AddDouble(&message_, field_of(message_, name), number);
  }
  template <Section S, std::size_t N>
  void operator()(const char* name, const std::array<S, N>& v) {
    for (const S& element : v) add_element(name, element);
  }
  template <Section S>
  void operator()(const char* name, const std::vector<S>& v) {
    for (const S& element : v) add_element(name, element);
  }

 private:
  void add_element(const char* name, const Section auto& v) {
    Writer writer(*reflection_.AddMessage(&message_, field_of(message_, name)));
    visit_fields(writer, v);
  }

  Message& message_;
  const Reflection& reflection_;
};

template <class S>
S read(const Message& message) {
  S config;
  Reader reader(message);
  visit_fields(reader, config);
  return config;
}

template <class M, class S>
M write(const S& config) {
  M message;
  Writer writer(message);
  visit_fields(writer, config);
  return message;
}

}  // namespace

MasterConfig to_struct(const proto::MasterConfig& message) { return read<MasterConfig>(message); }
SlaveConfig to_struct(const proto::SlaveConfig& message) { return read<SlaveConfig>(message); }
ImpairmentConfig to_struct(const proto::Impairment& message) { return read<ImpairmentConfig>(message); }
proto::MasterConfig to_message(const MasterConfig& config) { return write<proto::MasterConfig>(config); }
proto::SlaveConfig to_message(const SlaveConfig& config) { return write<proto::SlaveConfig>(config); }
proto::Impairment to_message(const ImpairmentConfig& config) { return write<proto::Impairment>(config); }

}  // namespace longreach
