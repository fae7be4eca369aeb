// Values survive the way to bytes and back. The bodies are read with the generated protobuf classes, not with
// the codec.
#include "common/wire/codec.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "tests/unit/common/wire/bodies.hpp"

namespace longreach::codec_test {
namespace {

using bodies::decode;
using bodies::Decoded;
using bodies::rejection_of;
using bodies::round_trip;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Codec, KeepsEveryFieldOfAMotionCommand) {
  const MotionCommand in = samples::command();
  const MotionCommand out = round_trip(in);
  EXPECT_EQ(out.engagement, 3u);
  EXPECT_EQ(out.request, Request::kEngage);
  EXPECT_EQ(out.mode, MotionMode::kRate);
  EXPECT_EQ(out.scale, 0.35);
  EXPECT_EQ(out.grip, true);
  EXPECT_TRUE(out.let_go);
  EXPECT_EQ(out.goal_kind, GoalKind::kGoalPosition);
  EXPECT_EQ(out.position_m, in.position_m);
  EXPECT_EQ(out.rotation_rad, Vector3(Vector3::Zero()));
  const MotionCommand turned = round_trip(samples::turn());
  EXPECT_EQ(turned.goal_kind, GoalKind::kGoalOrientation);
  EXPECT_EQ(turned.rotation_rad, samples::turn().rotation_rad);
  EXPECT_EQ(turned.position_m, Vector3(Vector3::Zero()));
}

TEST(Codec, KeepsEveryFieldOfTheStamp) {
  const Stamp in{PeerTime(Duration(123456789)), Echo{-5, Duration(250)}};
  const auto out =
      std::get<Decoded<MotionCommand>>(decode<MotionCommand>(samples::body_of(samples::command(), in)));
  EXPECT_EQ(out.stamp.sent, in.sent);
  ASSERT_TRUE(out.stamp.echo);
  EXPECT_EQ(out.stamp.echo->sent_ns, -5);
  EXPECT_EQ(out.stamp.echo->held, Duration(250));
}

TEST(Codec, KeepsEveryFieldOfAStiffnessReport) {
  StiffnessReport in = samples::report();
  in.rotation.surfaces[0].touch_sequence = 1200.25;
  in.rotation.surfaces[0].pressed = false;
  const StiffnessReport out = round_trip(in);
  EXPECT_EQ(out.engagement, 5u);
  EXPECT_EQ(out.state, SafetyState::kEngaged);
  EXPECT_EQ(out.cause, HoldCause::kOperator);
  EXPECT_EQ(out.cause.joint, 0);
  EXPECT_EQ(out.reached_sequence, 1230u);
  EXPECT_EQ(out.refused, 6u);
  EXPECT_EQ(out.refusal, Reason(HoldCause::kJointLimit, 5, 0.0, 0.0));
  EXPECT_EQ(out.refusal.value, 2.125);
  EXPECT_EQ(out.refusal.limit, 2.0);
  for (const auto& [got, sent] : {std::pair(out.translation, in.translation), {out.rotation, in.rotation}}) {
    EXPECT_EQ(got.place, sent.place);
    EXPECT_EQ(got.held_back, sent.held_back);
    EXPECT_EQ(got.threshold, sent.threshold);
    EXPECT_EQ(got.guard, sent.guard);
    for (std::size_t i = 0; i < kSurfaces; ++i) {
      const ReportedSurface &a = got.surfaces[i], &b = sent.surfaces[i];
      EXPECT_EQ(a.normal, b.normal);
      EXPECT_EQ(a.stiffness, b.stiffness);
      EXPECT_EQ(a.foot, b.foot);
      EXPECT_EQ(a.touch_sequence, b.touch_sequence);
      EXPECT_EQ(a.offset, b.offset);
      EXPECT_EQ(a.touch, b.touch);
      EXPECT_EQ(a.pressed, b.pressed);
    }
  }
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
  EXPECT_NEAR(out.estimate.depth_m, 0.002, 1e-9);
  EXPECT_TRUE(out.estimate.valid);
  EXPECT_EQ(out.estimate.k_sd, 300.0);
  EXPECT_EQ(out.estimate.lambda_sd, 200.0);
  EXPECT_EQ(out.estimate.n_sd, 0.125);
  EXPECT_EQ(out.estimate.correlation, -0.5);
  EXPECT_EQ(out.estimate.secant_n_per_m, 1000.0 / 1.5);
  EXPECT_EQ(out.estimate.stiffness_verdict, Verdict::kIdentified);
  EXPECT_EQ(out.estimate.k_verdict, Verdict::kNotYet);
  EXPECT_EQ(out.estimate.lambda_verdict, Verdict::kNotIdentifiable);
  EXPECT_EQ(out.estimate.n_verdict, Verdict::kIdentified);
  EXPECT_NEAR(out.penetration_m, 0.0015, 1e-9);
  const Clamps& c = out.clamps;
  EXPECT_TRUE(c.tool_speed && !c.joint_speed && c.joint_position && !c.workspace && c.force_guard &&
              !c.singularity && c.unreachable);
  EXPECT_EQ(out.up_loss, 0.25);
  EXPECT_EQ(out.up_jitter_s, 0.5);
  EXPECT_EQ(out.playout_delay_s, 0.125);
  EXPECT_EQ(out.rejected, 11u);
  EXPECT_EQ(out.limit_violations, 12u);
  EXPECT_EQ(out.late_ticks, 13u);
  EXPECT_TRUE(out.gripper.closed && out.gripper.holds);
  EXPECT_EQ(out.gripper.load_kg, 4.5);
  EXPECT_EQ(out.gripper.load_sd_kg, 0.25);
  EXPECT_EQ(out.load_acceleration_m_per_s2, 0.5);
  EXPECT_EQ(out.load_acceleration_rad_per_s2, 0.125);
}

TEST(Codec, KeepsThePosesOfBodiesByTheirNumbers) {
  const BodyPoses in = samples::body_poses();  // numbers that floats hold exactly
  const BodyPoses out = round_trip(in);
  for (std::size_t i = 0; i < kTrackedBodies; ++i) {
    ASSERT_EQ(out.body[i].has_value(), in.body[i].has_value()) << i;
    if (!in.body[i]) continue;
    EXPECT_EQ(out.body[i]->X_WB.p, in.body[i]->X_WB.p) << i;
    EXPECT_TRUE(out.body[i]->X_WB.q.isApprox(in.body[i]->X_WB.q, 1e-15)) << i;
    EXPECT_EQ(out.body[i]->age_s, in.body[i]->age_s) << i;
  }
  EXPECT_TRUE(round_trip(BodyPoses{}).empty());
}

TEST(Codec, RoundsThePosesOfBodiesByLessThanAMicrometre) {
  BodyPoses in;
  in.body[7] = BodyPose{{{1.234567, -2.345678, 0.1}, exp_rotation({0.3, -1.1, 0.7})}, 0.0123};
  const BodyPoses out = round_trip(in);
  EXPECT_LT((out.body[7]->X_WB.p - in.body[7]->X_WB.p).norm(), 1e-6);
  EXPECT_LT(log_rotation(out.body[7]->X_WB.q * in.body[7]->X_WB.q.conjugate()).norm(), 1e-6);
  EXPECT_NEAR(out.body[7]->X_WB.q.norm(), 1.0, 1e-15);
}

TEST(Codec, OmitsABodyWithAnImpossiblePose) {
  BodyPoses in = samples::body_poses();
  in.body[0]->X_WB.p.y() = std::numeric_limits<double>::quiet_NaN();
  in.body[1] = BodyPose{{Vector3::Constant(2e6), Quaternion::Identity()}, 0.0};
  in.body[2] = BodyPose{{Vector3::Zero(), Quaternion(0.0, 0.0, 0.0, 0.0)}, 0.0};
  in.body[3] = BodyPose{{}, -1.0};
  const BodyPoses out = round_trip(in);
  for (std::size_t i = 0; i < kTrackedBodies; ++i) EXPECT_EQ(out.body[i].has_value(), i == 4) << i;
}

TEST(Codec, ExtremeMessagesFitADatagramAndAreAccepted) {
  const Stamp stamp = samples::extreme_stamp();
  const std::string command = samples::body_of(samples::extreme_command(), stamp);
  const std::string report = samples::body_of(samples::extreme_report(), stamp);
  const std::string telemetry = samples::body_of(samples::extreme_telemetry(), stamp);
  const std::string bodies = samples::body_of(samples::extreme_body_poses(), stamp);
  // Header and tag of a sealed datagram, and room for fields to come.
  constexpr std::size_t kSealedBytes = 34, kRoomBytes = 16;
  for (const auto* body : {&command, &report, &telemetry, &bodies}) {
    EXPECT_LE(body->size() + kSealedBytes + kRoomBytes, 508u);
    RecordProperty("bytes_" + std::to_string(body->size()), "");
  }
  EXPECT_FALSE(rejection_of<MotionCommand>(command));
  EXPECT_FALSE(rejection_of<StiffnessReport>(report));
  EXPECT_FALSE(rejection_of<Telemetry>(telemetry));
  EXPECT_FALSE(rejection_of<BodyPoses>(bodies));
}

// The counts are those of the numbers in the schema.
TEST(Codec, SendsAnEstimateThatIsNotFiniteAsNotValid) {
  Telemetry t = samples::telemetry();
  t.estimate.stiffness_sd_n_per_m = kInfinity;
  EXPECT_FALSE(round_trip(t).estimate.valid);
  EXPECT_EQ(round_trip(t).estimate.stiffness_n_per_m, 0.0);
}

/// What default messages carry; the rest of what they hold does not cross the wire.
void expect_defaults(const MotionCommand& m) {
  EXPECT_EQ(m.position_m, Vector3(Vector3::Zero()));
  EXPECT_EQ(m.rotation_rad, Vector3(Vector3::Zero()));
}
void expect_defaults(const StiffnessReport& m) {
  EXPECT_EQ(m.translation.surfaces[0].touch, 0u);
  EXPECT_EQ(m.rotation.surfaces[0].touch, 0u);
}
void expect_defaults(const Telemetry& m) {
  EXPECT_EQ(m.estimate.k_sd, 0.0);
  EXPECT_EQ(m.estimate.correlation, 0.0);
  EXPECT_EQ(m.estimate.n_verdict, ContactEstimate{}.n_verdict);
}
void expect_defaults(const BodyPoses& m) { EXPECT_TRUE(m.empty()); }

template <class Message>
void expect_that_nothing_of_it_stays(const Message& before) {
  Codec codec;
  std::array<std::byte, kBodyMaxBytes> body;
  codec.encode(samples::extreme_stamp(), before, body);
  const std::size_t size = codec.encode(Stamp{}, Message{}, body);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(body.data()), size),
            samples::body_of(Message{}, Stamp{}));

  Decoded<Message> decoded;
  const std::string full = samples::body_of(before, samples::extreme_stamp());
  ASSERT_FALSE(codec.decode(std::as_bytes(std::span(full)), decoded.stamp, decoded.message));
  ASSERT_FALSE(codec.decode(std::span(body).first(size), decoded.stamp, decoded.message));
  EXPECT_EQ(samples::body_of(decoded.message, decoded.stamp), samples::body_of(Message{}, Stamp{}));
  expect_defaults(decoded.message);
}

TEST(Codec, RemembersNothingOfTheMessageBefore) {
  expect_that_nothing_of_it_stays(samples::command());
  expect_that_nothing_of_it_stays(samples::turn());
  expect_that_nothing_of_it_stays(samples::report());
  expect_that_nothing_of_it_stays(samples::telemetry());
  expect_that_nothing_of_it_stays(samples::body_poses());
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
}  // namespace longreach::codec_test
