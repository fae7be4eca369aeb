// Plain structs from messages, and back, over the lists in struct_fields.hpp.

#include <google/protobuf/message.h>

#include <array>
#include <optional>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/struct_fields.hpp"
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

// The enums of structs are cast from those of the schema.
template <Enum E>
constexpr bool same(E ours, int theirs) {
  return static_cast<int>(ours) == theirs;
}
static_assert(same(Accuracy::kFast, proto::FAST) && same(Accuracy::kBalanced, proto::BALANCED) &&
              same(Accuracy::kExact, proto::EXACT) && proto::Accuracy_ARRAYSIZE == 3);
static_assert(same(MotionMode::kRate, proto::Mapping::RATE) &&
              same(MotionMode::kPosition, proto::Mapping::POSITION) && proto::Mapping::Mode_ARRAYSIZE == 2);
static_assert(same(RateLaw::kContinuous, proto::Mapping::CONTINUOUS) &&
              same(RateLaw::kLiteral, proto::Mapping::LITERAL) && proto::Mapping::RateLaw_ARRAYSIZE == 2);
static_assert(same(RenderingLaw::kStiffness, proto::Rendering::STIFFNESS) &&
              same(RenderingLaw::kNaive, proto::Rendering::NAIVE) &&
              same(RenderingLaw::kDirect, proto::Rendering::DIRECT) &&
              same(RenderingLaw::kPositionPosition, proto::Rendering::POSITION_POSITION) &&
              same(RenderingLaw::kWave, proto::Rendering::WAVE) &&
              same(RenderingLaw::kTdpa, proto::Rendering::TDPA) &&
              same(RenderingLaw::kTank, proto::Rendering::TANK) && proto::Rendering::Law_ARRAYSIZE == 7);
static_assert(same(IdleRule::kHome, proto::Behaviour::HOME) &&
              same(IdleRule::kStay, proto::Behaviour::STAY) && proto::Behaviour::Idle_ARRAYSIZE == 2);
static_assert(same(HandleMotion::kCoupled, proto::Behaviour::COUPLED) &&
              same(HandleMotion::kDecoupled, proto::Behaviour::DECOUPLED) &&
              proto::Behaviour::Motion_ARRAYSIZE == 2);
static_assert(same(Registration::kTouch, proto::Rendering::TOUCH) &&
              same(Registration::kArrival, proto::Rendering::ARRIVAL) &&
              proto::Rendering::Registration_ARRAYSIZE == 2);
static_assert(same(EstimatorKind::kFixedExponent, proto::Estimator::FIXED_EXPONENT) &&
              same(EstimatorKind::kMaximumLikelihood, proto::Estimator::MAXIMUM_LIKELIHOOD) &&
              proto::Estimator::Kind_ARRAYSIZE == 5);
static_assert(same(Presence::kIgnore, proto::MasterSafety::IGNORE) &&
              same(Presence::kHold, proto::MasterSafety::HOLD) &&
              proto::MasterSafety::Presence_ARRAYSIZE == 2);
static_assert(same(Grip::kLight, proto::Hand::LIGHT) && same(Grip::kFirm, proto::Hand::FIRM) &&
              same(Grip::kReleased, proto::Hand::RELEASED) && proto::Hand::Grip_ARRAYSIZE == 3);
static_assert(same(OperatorKind::kNone, proto::Operator::NONE) &&
              same(OperatorKind::kScript, proto::Operator::SCRIPT) &&
              same(OperatorKind::kKeyboard, proto::Operator::KEYBOARD) &&
              same(OperatorKind::kGamepad, proto::Operator::GAMEPAD) &&
              same(OperatorKind::kSpaceMouse, proto::Operator::SPACEMOUSE) &&
              proto::Operator::Kind_ARRAYSIZE == 5);
static_assert(same(JointKind::kRevolute, proto::Joint::REVOLUTE) &&
              same(JointKind::kPrismatic, proto::Joint::PRISMATIC) &&
              same(JointKind::kFixed, proto::Joint::FIXED) && proto::Joint::Kind_ARRAYSIZE == 3);
static_assert(same(DhConvention::kStandard, proto::Robot::STANDARD) &&
              same(DhConvention::kModified, proto::Robot::MODIFIED) &&
              proto::Robot::Convention_ARRAYSIZE == 2);
static_assert(same(BranchPreference::kNearest, proto::Robot::NEAREST) &&
              same(BranchPreference::kSoonest, proto::Robot::SOONEST) &&
              same(BranchPreference::kCentred, proto::Robot::CENTRED) &&
              proto::Robot::Preference_ARRAYSIZE == 3);

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
