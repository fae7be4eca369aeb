// Values survive the way to bytes and back; whatever cannot be meant is refused. The bodies are built with
// the generated protobuf classes, not with the codec.
#include "common/wire/codec.hpp"

#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/core/random.hpp"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"
#include "tests/unit/wire/samples.hpp"

namespace longreach {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Message>
std::variant<Decoded<Message>, Rejection> decode(const std::string& body) {
  Codec codec;
  return codec.decode<Message>(std::as_bytes(std::span(body)));
}

template <class Message>
Message round_trip(const Message& message) {
  return std::get<Decoded<Message>>(decode<Message>(samples::body_of(message))).message;
}

template <class Message>
std::optional<Rejection> rejection_of(const std::string& body) {
  const auto decoded = decode<Message>(body);
  return std::holds_alternative<Rejection>(decoded) ? std::optional(std::get<Rejection>(decoded))
                                                    : std::nullopt;
}

template <class Wire, class Message>
Wire wire_of(const Message& message) {
  Wire wire;
  EXPECT_TRUE(wire.ParseFromString(samples::body_of(message)));
  return wire;
}

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

TEST(Codec, KeepsEveryFieldOfAMotionCommand) {
  const MotionCommand in = samples::command();
  const MotionCommand out = round_trip(in);
  EXPECT_EQ(out.engagement, 3u);
  EXPECT_EQ(out.request, Request::kEngage);
  EXPECT_EQ(out.mode, MotionMode::kRate);
  EXPECT_EQ(out.scale, 0.35);
  EXPECT_EQ(out.goal_kind, GoalKind::kPosition);
  EXPECT_EQ(out.position_m, in.position_m);
  EXPECT_EQ(out.rotation_rad, Vector3(Vector3::Zero()));
  const MotionCommand turned = round_trip(samples::turn());
  EXPECT_EQ(turned.goal_kind, GoalKind::kOrientation);
  EXPECT_EQ(turned.rotation_rad, samples::turn().rotation_rad);
  EXPECT_EQ(turned.position_m, Vector3(Vector3::Zero()));
}

TEST(Codec, KeepsEveryFieldOfTheStamp) {
  const Stamp in{PeerTime(Duration(123456789)), Echo{77, -5, Duration(250)}};
  const auto out =
      std::get<Decoded<MotionCommand>>(decode<MotionCommand>(samples::body_of(samples::command(), in)));
  EXPECT_EQ(out.stamp.sent, in.sent);
  EXPECT_EQ(out.stamp.echo.session, 77u);
  EXPECT_EQ(out.stamp.echo.sent_ns, -5);
  EXPECT_EQ(out.stamp.echo.held, Duration(250));
}

TEST(Codec, KeepsEveryFieldOfAStiffnessReport) {
  const StiffnessReport in = samples::report();
  const StiffnessReport out = round_trip(in);
  EXPECT_EQ(out.engagement, 5u);
  EXPECT_EQ(out.state, SafetyState::kEngaged);
  EXPECT_EQ(out.cause, HoldCause::kOperator);
  EXPECT_EQ(out.reached_sequence, 1230u);
  EXPECT_EQ(out.translation.stiffness, in.translation.stiffness);
  EXPECT_EQ(out.translation.touch_sequence, 1234.75);
  EXPECT_EQ(out.translation.touch, 7u);
  EXPECT_TRUE(out.translation.in_contact);
  EXPECT_EQ(out.rotation.stiffness, in.rotation.stiffness);
}

TEST(Codec, KeepsEveryFieldOfTelemetry) {
  const Telemetry in = samples::telemetry();  // numbers that floats hold exactly
  const Telemetry out = round_trip(in);
  EXPECT_EQ(out.state, in.state);
  EXPECT_EQ(out.cause, in.cause);
  EXPECT_EQ(out.engagement, in.engagement);
  EXPECT_EQ(out.X_WE.p, in.X_WE.p);
  EXPECT_TRUE(out.X_WE.q.isApprox(in.X_WE.q, 1e-15));
  EXPECT_EQ(out.X_WE_goal.p, in.X_WE_goal.p);
  EXPECT_TRUE(out.X_WE_goal.q.isApprox(in.X_WE_goal.q, 1e-15));
  EXPECT_EQ(out.joint_rad, in.joint_rad);
  EXPECT_EQ(out.F_E_W.force, in.F_E_W.force);
  EXPECT_EQ(out.F_E_W.moment, in.F_E_W.moment);
  EXPECT_EQ(out.estimate.stiffness_n_per_m, 1000.0);
  EXPECT_EQ(out.estimate.stiffness_sd_n_per_m, 10.0);
  EXPECT_EQ(out.estimate.k, 3e4);
  EXPECT_EQ(out.estimate.lambda, 3e3);
  EXPECT_EQ(out.estimate.n, 1.5);
  EXPECT_EQ(out.estimate.depth_m, 0.002);
  EXPECT_TRUE(out.estimate.valid);
  EXPECT_EQ(out.penetration_m, 0.0015);
  const Clamps& c = out.clamps;
  EXPECT_TRUE(c.tool_speed && !c.joint_speed && c.joint_position && !c.workspace && c.force_guard &&
              !c.singularity && c.unreachable);
  EXPECT_EQ(out.up_loss, 0.25);
  EXPECT_EQ(out.up_jitter_s, 0.5);
  EXPECT_EQ(out.playout_delay_s, 0.125);
  EXPECT_EQ(out.rejected, 11u);
  EXPECT_EQ(out.limit_violations, 12u);
  EXPECT_EQ(out.late_ticks, 13u);
}

TEST(Codec, ExtremeMessagesFitADatagramAndAreAccepted) {
  const Stamp stamp = samples::extreme_stamp();
  const std::string command = samples::body_of(samples::extreme_command(), stamp);
  const std::string report = samples::body_of(samples::extreme_report(), stamp);
  const std::string telemetry = samples::body_of(samples::extreme_telemetry(), stamp);
  for (const auto* body : {&command, &report, &telemetry}) EXPECT_LE(body->size() + 22, 508u);
  EXPECT_FALSE(rejection_of<MotionCommand>(command));
  EXPECT_FALSE(rejection_of<StiffnessReport>(report));
  EXPECT_FALSE(rejection_of<Telemetry>(telemetry));
}

// The counts are those of the numbers in the schema.
TEST(Codec, RefusesNanAndInfinityInEveryField) {
  EXPECT_EQ(refuses_in_every_field<MotionCommand>(wire_of<proto::MotionCommand>(samples::command())), 4);
  EXPECT_EQ(refuses_in_every_field<MotionCommand>(wire_of<proto::MotionCommand>(samples::turn())), 4);
  EXPECT_EQ(refuses_in_every_field<StiffnessReport>(wire_of<proto::StiffnessReport>(samples::report())), 14);
  EXPECT_EQ(refuses_in_every_field<Telemetry>(wire_of<proto::Telemetry>(samples::telemetry())), 36);
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
  command.set_request(3);
  EXPECT_EQ(rejection_of<MotionCommand>(command.SerializeAsString()), Rejection::kValue);
  command.set_request(0);
  command.set_mode(2);
  EXPECT_EQ(rejection_of<MotionCommand>(command.SerializeAsString()), Rejection::kValue);
  auto report = wire_of<proto::StiffnessReport>(samples::report());
  report.set_state(6);
  EXPECT_EQ(rejection_of<StiffnessReport>(report.SerializeAsString()), Rejection::kValue);
  report.set_state(5);
  report.set_cause(8);
  EXPECT_EQ(rejection_of<StiffnessReport>(report.SerializeAsString()), Rejection::kValue);
  auto telemetry = wire_of<proto::Telemetry>(samples::telemetry());
  telemetry.set_clamps(1u << 7);
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
  wire.add_rotation_rad(0.5);
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
}

TEST(Codec, RefusesStiffnessOfAnotherShapeOrSize) {
  auto wire = wire_of<proto::StiffnessReport>(samples::report());
  auto& k = *wire.mutable_translation()->mutable_stiffness();
  k.Set(3, 1.1e12);
  EXPECT_EQ(rejection_of<StiffnessReport>(wire.SerializeAsString()), Rejection::kValue);
  k.Clear();
  for (int size = 0; size <= 7; ++size) {
    EXPECT_EQ(rejection_of<StiffnessReport>(wire.SerializeAsString()).has_value(), size != 0 && size != 6)
        << size;
    k.Add(1.0);
  }
  k.Clear();
  wire.mutable_rotation()->set_touch_sequence(-1.0);
  EXPECT_EQ(rejection_of<StiffnessReport>(wire.SerializeAsString()), Rejection::kValue);
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

TEST(Codec, RefusesImpossibleInstants) {
  auto wire = wire_of<proto::MotionCommand>(samples::command());
  wire.mutable_stamp()->set_sent_ns(std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
  wire.mutable_stamp()->set_sent_ns(1);
  wire.mutable_stamp()->set_echo_sent_ns(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
  wire.mutable_stamp()->set_echo_sent_ns(1);
  wire.mutable_stamp()->set_echo_held_ns(-1);
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
  wire.clear_stamp();
  EXPECT_EQ(rejection_of<MotionCommand>(wire.SerializeAsString()), Rejection::kValue);
}

TEST(Codec, SendsAnEstimateThatIsNotFiniteAsNotValid) {
  Telemetry t = samples::telemetry();
  t.estimate.stiffness_sd_n_per_m = kInfinity;
  EXPECT_FALSE(round_trip(t).estimate.valid);
  EXPECT_EQ(round_trip(t).estimate.stiffness_n_per_m, 0.0);
}

TEST(Codec, RemembersNothingOfTheMessageBefore) {
  Codec codec;
  std::array<std::byte, kBodyMaxBytes> body;
  codec.encode(samples::stamp(), samples::command(), body);
  const std::size_t size = codec.encode(samples::stamp(), MotionCommand{}, body);
  const auto out =
      std::get<Decoded<MotionCommand>>(codec.decode<MotionCommand>(std::span(body).first(size))).message;
  EXPECT_EQ(out.engagement, 0u);
  EXPECT_EQ(out.position_m, Vector3(Vector3::Zero()));
  EXPECT_EQ(out.scale, 1.0);
}

TEST(Codec, SurvivesRandomBodies) {
  Random random(11);
  int refused = 0;
  for (int run = 0; run < 20000; ++run) {
    std::string body =
        run % 2 == 0 ? std::string(random.next() % 487, '\0') : samples::body_of(samples::telemetry());
    if (run % 2 == 0) {
      for (char& c : body) c = static_cast<char>(random.next());
    } else {
      for (int i = 0; i < 4; ++i) body[random.next() % body.size()] = static_cast<char>(random.next());
    }
    const auto decoded = decode<Telemetry>(body);
    if (std::holds_alternative<Rejection>(decoded)) {
      ++refused;
      continue;
    }
    const Telemetry& t = std::get<Decoded<Telemetry>>(decoded).message;
    EXPECT_TRUE(t.X_WE.p.allFinite() && t.F_E_W.force.allFinite() && std::isfinite(t.estimate.k)) << run;
  }
  EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace longreach
