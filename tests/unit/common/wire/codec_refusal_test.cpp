// Whatever cannot be meant is refused. The bodies are built with the generated protobuf classes, not with the
// codec.
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <functional>

#include "common/wire/codec.hpp"
#include "tests/unit/common/wire/bodies.hpp"

namespace longreach::codec_refusal_test {
namespace {

using bodies::decode;
using bodies::rejection_of;
using bodies::round_trip;
using bodies::wire_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Calls `try_it` once for every floating-point field that is there (each element of a repeated one), after
/// having set it to `value`; restores it.
void for_each_number(google::protobuf::Message& message, double value,
                     const std::function<void(std::string)>& try_it) {
  using Field = google::protobuf::FieldDescriptor;
  const auto* reflection = message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const Field* field = message.GetDescriptor()->field(i);
    const int count = field->is_repeated() ? reflection->FieldSize(message, field) : 1;
    for (int k = 0; k < count; ++k) {
      const std::string name = field->full_name() + "[" + std::to_string(k) + "]";
      if (field->cpp_type() == Field::CPPTYPE_MESSAGE) {
        for_each_number(*reflection->MutableMessage(&message, field), value, try_it);
      } else if (field->cpp_type() == Field::CPPTYPE_DOUBLE && field->is_repeated()) {
        const double before = reflection->GetRepeatedDouble(message, field, k);
        reflection->SetRepeatedDouble(&message, field, k, value);
        try_it(name);
        reflection->SetRepeatedDouble(&message, field, k, before);
      } else if (field->cpp_type() == Field::CPPTYPE_DOUBLE) {
        const double before = reflection->GetDouble(message, field);
        reflection->SetDouble(&message, field, value);
        try_it(name);
        reflection->SetDouble(&message, field, before);
      } else if (field->cpp_type() == Field::CPPTYPE_FLOAT && field->is_repeated()) {
        const float before = reflection->GetRepeatedFloat(message, field, k);
        reflection->SetRepeatedFloat(&message, field, k, static_cast<float>(value));
        try_it(name);
        reflection->SetRepeatedFloat(&message, field, k, before);
      } else if (field->cpp_type() == Field::CPPTYPE_FLOAT) {
        const float before = reflection->GetFloat(message, field);
        reflection->SetFloat(&message, field, static_cast<float>(value));
        try_it(name);
        reflection->SetFloat(&message, field, before);
      }
    }
  }
}

template <class Message, class Wire>
int refuses_in_every_field(Wire wire) {
  int tried = 0;
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    for_each_number(wire, value, [&](const std::string& name) {
      ++tried;
      EXPECT_EQ(rejection_of<Message>(wire.SerializeAsString()), Rejection::kValue) << name << " = " << value;
    });
  }
  EXPECT_FALSE(rejection_of<Message>(wire.SerializeAsString()));  // and the unharmed one passes
  return tried / 3;
}

TEST(Codec, RefusesNanAndInfinityInEveryField) {
  EXPECT_EQ(refuses_in_every_field<MotionCommand>(wire_of<proto::MotionCommand>(samples::command())), 4);
  EXPECT_EQ(refuses_in_every_field<MotionCommand>(wire_of<proto::MotionCommand>(samples::turn())), 4);
  EXPECT_EQ(refuses_in_every_field<StiffnessReport>(wire_of<proto::StiffnessReport>(samples::report())), 44);
  EXPECT_EQ(refuses_in_every_field<Telemetry>(wire_of<proto::Telemetry>(samples::telemetry())), 44);
  EXPECT_EQ(refuses_in_every_field<BodyPoses>(wire_of<proto::BodyPoses>(samples::body_poses())), 16);
}

TEST(Codec, RefusesGoalsBeyondReason) {
  for (const double metres : {1000.1, -1000.1, 1e9, 1e300}) {
    MotionCommand c = samples::command();
    c.position_m.y() = metres;
    EXPECT_EQ(rejection_of<MotionCommand>(samples::body_of(c)), Rejection::kValue) << metres;
  }
  for (const double rad : {100.1, -100.1, 1e9, 1e300}) {
    MotionCommand c = samples::turn();
    c.rotation_rad.z() = rad;
    EXPECT_EQ(rejection_of<MotionCommand>(samples::body_of(c)), Rejection::kValue) << rad;
  }
  MotionCommand edge = samples::command();
  edge.position_m = {1e3, -1e3, 5e-324};
  EXPECT_EQ(round_trip(edge).position_m, edge.position_m);
}

TEST(Codec, RefusesScalesOutsideTheirRangeButForgivesRounding) {
  for (const double scale : {0.0, 0.049, 1.001, -1.0, 1e9, 1e-9}) {
    MotionCommand c = samples::command();
    c.scale = scale;
    EXPECT_EQ(rejection_of<MotionCommand>(samples::body_of(c)), Rejection::kValue) << scale;
  }
  MotionCommand c = samples::command();
  c.scale = 1.0;
  for (int i = 0; i < 19; ++i) c.scale -= 0.05;
  ASSERT_NE(c.scale, 0.05);
  EXPECT_EQ(round_trip(c).scale, std::max(c.scale, 0.05));
}

TEST(Codec, RefusesUnknownEnumerators) {
  auto command = wire_of<proto::MotionCommand>(samples::command());
  command.set_request(4);
  EXPECT_EQ(rejection_of<MotionCommand>(command.SerializeAsString()), Rejection::kValue);
  command.set_request(0);
  command.set_mode(2);
  EXPECT_EQ(rejection_of<MotionCommand>(command.SerializeAsString()), Rejection::kValue);
  auto report = wire_of<proto::StiffnessReport>(samples::report());
  report.set_state(6);
  EXPECT_EQ(rejection_of<StiffnessReport>(report.SerializeAsString()), Rejection::kValue);
  report.set_state(5);
  report.set_cause(kCountOf<HoldCause>);
  EXPECT_EQ(rejection_of<StiffnessReport>(report.SerializeAsString()), Rejection::kValue);
  auto telemetry = wire_of<proto::Telemetry>(samples::telemetry());
  for (const std::uint32_t unknown : {7u << 9, 1u << 13}) {  // joint 7; a bit without a meaning
    telemetry.set_clamps(unknown);
    EXPECT_EQ(rejection_of<Telemetry>(telemetry.SerializeAsString()), Rejection::kValue);
  }
  telemetry.set_clamps(0);
  telemetry.set_verdicts(1u << 8);
  EXPECT_EQ(rejection_of<Telemetry>(telemetry.SerializeAsString()), Rejection::kValue);
}

TEST(Codec, RefusesACommandWithoutOrWithTwoGoals) {
  auto wire = wire_of<proto::MotionCommand>(samples::command());
  wire.clear_position_m();
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
  for (int size = 1; size <= 4; ++size) {
    wire.add_position_m(0.5);
    EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()).has_value(), size != 3) << size;
  }
  wire = wire_of<proto::MotionCommand>(samples::command());
  for (int size = 1; size <= 4; ++size) {
    wire.add_rotation_rad(0.5);
    EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue) << size;
  }
}

TEST(Codec, RefusesSurfacesThatAreNone) {
  using Wire = proto::StiffnessReport;
  const auto refused = [](const auto& change) {
    auto wire = wire_of<Wire>(samples::report());
    change(wire);
    return rejection_of<StiffnessReport>(wire.SerializeAsString()) == Rejection::kValue;
  };
  EXPECT_FALSE(refused([](Wire&) {}));
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_lines(0, -0.9f); })) << "a normal shorter than unit";
  EXPECT_TRUE(refused([](Wire& w) { w.set_rotation_lines(1, 0.1f); })) << "longer than unit";
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_lines(3, -1.0f); })) << "a negative stiffness";
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_lines(3, 1.1e12f); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_lines(4, -1e-3f); }))
      << "a foot in front of the surface";
  EXPECT_TRUE(refused([](Wire& w) { w.set_rotation_lines(4, 101.0f); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_places(0, -1.0); })) << "a sequence below zero";
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_places(0, 1e16); }));
  EXPECT_FALSE(refused([](Wire& w) { w.set_translation_places(1, -1000.0); })) << "an offset may be negative";
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_places(1, -1000.1); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_rotation_touches(1, 3); })) << "no touch";
  EXPECT_TRUE(refused([](Wire& w) { w.add_translation_lines(0.0f); }));
  EXPECT_TRUE(refused([](Wire& w) { w.add_translation_places(0.0); }));
  EXPECT_TRUE(refused([](Wire& w) { w.add_rotation_touches(4); }));
  EXPECT_TRUE(refused([](Wire& w) {
    for (int i = 0; i < 2; ++i) {
      for (const float v : {1.0f, 0.0f, 0.0f, 5.0f, 0.0f}) w.add_translation_lines(v);
      w.add_translation_places(1.0);
      w.add_translation_touches(4);
    }
  })) << "four surfaces";
}

TEST(Codec, RefusesPlacesAndDirectionsThatAreNone) {
  const auto refused = [](const auto& change) {
    auto wire = wire_of<proto::StiffnessReport>(samples::report());
    change(wire);
    return rejection_of<StiffnessReport>(wire.SerializeAsString()) == Rejection::kValue;
  };
  using Wire = proto::StiffnessReport;
  EXPECT_FALSE(refused([](Wire& w) { w.clear_translation_tool_m(); }));
  EXPECT_FALSE(refused([](Wire& w) { w.clear_translation_held_back(); }));
  EXPECT_TRUE(refused([](Wire& w) { w.add_translation_tool_m(0.0); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_tool_m(1, 1000.1); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_rotation_tool_rad(1, -100.1); }));
  EXPECT_TRUE(refused([](Wire& w) { w.add_rotation_held_back(0.0); }));
  EXPECT_TRUE(refused([](Wire& w) { w.set_rotation_held_back(0, 0.5); })) << "longer than unit";
  EXPECT_TRUE(refused([](Wire& w) { w.set_translation_held_back(2, 0.0); })) << "shorter than unit";
}

TEST(Codec, RefusesPosesThatAreNone) {
  auto wire = wire_of<proto::Telemetry>(samples::telemetry());
  wire.mutable_tool()->set_quaternion(0, 0.6);
  EXPECT_EQ(rejection_of<Telemetry>(wire.SerializeAsString()), Rejection::kValue);
  wire = wire_of<proto::Telemetry>(samples::telemetry());
  for (int i = 0; i < 4; ++i) wire.mutable_goal()->set_quaternion(i, 0.0);
  EXPECT_EQ(rejection_of<Telemetry>(wire.SerializeAsString()), Rejection::kValue);
  wire = wire_of<proto::Telemetry>(samples::telemetry());
  wire.clear_tool();
  EXPECT_EQ(rejection_of<Telemetry>(wire.SerializeAsString()), Rejection::kValue);
  wire = wire_of<proto::Telemetry>(samples::telemetry());
  wire.add_joint_rad(0.0f);
  EXPECT_EQ(rejection_of<Telemetry>(wire.SerializeAsString()), Rejection::kValue);
}

TEST(Codec, RefusesBodiesThatAreNone) {
  using Wire = proto::BodyPoses;
  const auto refused = [](const BodyPoses& bodies, const auto& change) {
    auto wire = wire_of<Wire>(bodies);
    change(wire);
    return rejection_of<BodyPoses>(wire.SerializeAsString()) == Rejection::kValue;
  };
  const BodyPoses two = samples::body_poses(), eight = samples::extreme_body_poses();
  const auto add = [](Wire& w, std::uint32_t number) {
    w.add_bodies(number);
    for (const float v : {1.0f, 2.0f, 3.0f}) w.add_positions_m(v);
    for (const float v : {0.0f, 0.0f, 0.0f, 1.0f}) w.add_quaternions(v);
    w.add_ages_s(0.0f);
  };
  EXPECT_FALSE(refused(two, [](Wire&) {}));
  EXPECT_FALSE(refused(two, [&](Wire& w) { add(w, 8); }));
  EXPECT_TRUE(refused(two, [&](Wire& w) { add(w, 9); })) << "an unknown number";
  EXPECT_TRUE(refused(eight, [&](Wire& w) { add(w, 9); })) << "nine bodies";
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_bodies(0, 0); })) << "numbers begin with 1";
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_bodies(0, 5); })) << "the same body twice";
  EXPECT_TRUE(refused(two, [&](Wire& w) { add(w, 3); })) << "not in ascending order";
  EXPECT_TRUE(refused(two, [](Wire& w) { w.add_bodies(8); })) << "no pose";
  EXPECT_TRUE(refused(two, [](Wire& w) { w.add_positions_m(0.0f); }));
  EXPECT_TRUE(refused(two, [](Wire& w) { w.add_quaternions(0.0f); }));
  EXPECT_TRUE(refused(two, [](Wire& w) { w.clear_ages_s(); }));
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_positions_m(4, -1.1e6f); }));
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_quaternions(0, 0.6f); })) << "longer than unit";
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_ages_s(1, -0.1f); }));
  EXPECT_TRUE(refused(two, [](Wire& w) { w.set_ages_s(1, 1.1e6f); }));
}

template <class Message, class Wire>
void refuses_impossible_instants(Wire wire) {
  const auto rejection = [&] { return rejection_of<Message>(wire.SerializeAsString()); };
  wire.set_sent_ns(std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(rejection(), Rejection::kValue);
  wire.set_sent_ns(1);
  EXPECT_FALSE(rejection());
  wire.set_echo_sent_ns(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(rejection(), Rejection::kValue);
  wire.set_echo_sent_ns(1);
  for (const std::int64_t held_ns : {std::int64_t{-1}, kHeldMaxNs + 1}) {
    wire.set_echo_held_ns(held_ns);
    EXPECT_EQ(rejection(), Rejection::kValue) << held_ns;
  }
  wire.set_echo_held_ns(kHeldMaxNs);
  EXPECT_FALSE(rejection());
  wire.clear_sent_ns();
  EXPECT_EQ(rejection(), Rejection::kValue);
}

TEST(Codec, RefusesImpossibleInstants) {
  refuses_impossible_instants<MotionCommand>(wire_of<proto::MotionCommand>(samples::command()));
  refuses_impossible_instants<StiffnessReport>(wire_of<proto::StiffnessReport>(samples::report()));
  refuses_impossible_instants<Telemetry>(wire_of<proto::Telemetry>(samples::telemetry()));
  refuses_impossible_instants<BodyPoses>(wire_of<proto::BodyPoses>(samples::body_poses()));
}

}  // namespace
}  // namespace longreach::codec_refusal_test
