// What is recorded comes back bit for bit: a replay lives of it.
#include "common/recording/recorded_values.hpp"

#include <gtest/gtest.h>

#include <cctype>

#include <bit>
#include <cstring>
#include <limits>

#include "master/recording/master_record_buffer.hpp"
#include "slave/recording/slave_record_buffer.hpp"

namespace longreach::recorded_values_test {
namespace {

/// Another number, of every kind there is, at each call.
class Numbers {
 public:
  double next() {
    const double special[] = {0.0,
                              -0.0,
                              std::numeric_limits<double>::denorm_min(),
                              -std::numeric_limits<double>::infinity(),
                              std::bit_cast<double>(0x7ff80000deadbeefULL),  // NaN with a payload
                              std::numeric_limits<double>::max(),
                              0.1,
                              -1.0 / 3.0};
    ++count_;
    return count_ % 3 == 0 ? special[count_ / 3 % std::size(special)] : 1.25 * count_ + 1e-9;
  }
  Vector3 vector() {
    const double x = next(), y = next();
    return {x, y, next()};
  }
  Quaternion quaternion() {
    const double w = next(), x = next(), y = next();
    return {w, x, y, next()};
  }
  Pose pose() {
    const Vector3 p = vector();
    return {p, quaternion()};
  }
  Wrench wrench() {
    const Vector3 moment = vector();
    return {moment, vector()};
  }

 private:
  int count_ = 0;
};

/// Written once more after it was read: the same bytes, if nothing was lost on the way; and as many as the
/// fields of the type.
template <class Recorded, class Value>
void expect_kept(const Value& value) {
  Recorded first;
  write(value, first);
  std::string bytes = first.SerializeAsString();
  Recorded parsed;
  ASSERT_TRUE(parsed.ParseFromString(bytes));
  Recorded second;
  write(read(parsed), second);
  EXPECT_TRUE(second.SerializeAsString() == bytes) << first.DebugString() << second.DebugString();
}

MotionCommand sample_command(Numbers& n) {
  MotionCommand c{7, Request::kLetGo, MotionMode::kRate, n.next(), true, true, GoalKind::kOrientation};
  c.position_m = n.vector();
  c.rotation_rad = n.vector();
  return c;
}

ContactReport sample_contact(Numbers& n) {
  ContactReport c;
  for (ReportedSurface& s : c.surfaces) {
    s = {.normal = n.vector(),
         .stiffness = n.next(),
         .foot = n.next(),
         .touch_sequence = n.next(),
         .offset = n.next(),
         .touch = 4'000'000'000,
         .pressed = true};
  }
  c.place = n.vector();
  c.held_back = n.vector();
  c.threshold = n.next();
  return c;
}

StiffnessReport sample_report(Numbers& n) {
  return {9,
          SafetyState::kFault,
          {HoldCause::kJointOutside, 5, 30.1, 2.094},
          sample_contact(n),
          sample_contact(n),
          ~0ULL,
          10,
          {HoldCause::kToolOutside, 0, 0.7, 0.5}};
}

Telemetry sample_telemetry(Numbers& n) {
  Telemetry t;
  t.state = SafetyState::kStopped;
  t.cause = HoldCause::kRobotTrackingLost;
  t.engagement = 3;
  t.X_WE = n.pose();
  t.X_WE_goal = n.pose();
  for (double& joint : t.joint_rad) joint = n.next();
  t.F_E_W = n.wrench();
  t.estimate = {n.next(),
                n.next(),
                n.next(),
                n.next(),
                n.next(),
                n.next(),
                true,
                n.next(),
                n.next(),
                n.next(),
                n.next(),
                n.next(),
                Verdict::kNotIdentifiable,
                Verdict::kIdentified,
                Verdict::kNotYet,
                Verdict::kNotIdentifiable};
  t.penetration_m = n.next();
  t.clamps = {true, false, true, true, false, true, true};
  t.up_loss = n.next();
  t.up_jitter_s = n.next();
  t.playout_delay_s = n.next();
  t.rejected = 1;
  t.limit_violations = 2;
  t.late_ticks = 3;
  t.gripper = {true, true, 4.5, 0.25};
  return t;
}

template <class Message>
Received<Message> received(const Message& message) {
  return {11,
          PeerTime(Duration(-5)),
          Time(Duration(std::numeric_limits<std::int64_t>::max())),
          Time(Duration(1)),
          Duration(7),
          true,
          message};
}

TEST(RecordedValues, KeepEveryBitOfMessages) {
  Numbers n;
  expect_kept<recording::ReceivedCommand>(received(sample_command(n)));
  expect_kept<recording::ReceivedReport>(received(sample_report(n)));
  expect_kept<recording::ReceivedTelemetry>(received(sample_telemetry(n)));
  Received<StiffnessReport> plain = received(StiffnessReport{});
  plain.echo_sent.reset();
  expect_kept<recording::ReceivedReport>(plain);
  recording::ReceivedReport recorded;
  write(plain, recorded);
  EXPECT_FALSE(read(recorded).echo_sent) << "absent is not zero";
  EXPECT_EQ(read(recorded).rtt, Duration(7));
  plain.rtt = kNoRtt;
  recorded.Clear();
  write(plain, recorded);
  EXPECT_EQ(read(recorded).rtt, kNoRtt);
}

TEST(RecordedValues, KeepTheBitsThemselves) {
  Numbers n;
  for (int i = 0; i < 40; ++i) {
    const Vector3 v = n.vector();
    recording::Vector recorded;
    write(v, recorded);
    recording::Vector parsed;
    ASSERT_TRUE(parsed.ParseFromString(recorded.SerializeAsString()));
    const Vector3 back = read(parsed);
    EXPECT_EQ(std::memcmp(v.data(), back.data(), sizeof(double) * 3), 0) << v.transpose();
  }
}

TEST(RecordedValues, KeepEveryBitOfTheMastersInput) {
  Numbers n;
  MasterInput in;
  in.now = Time(Duration(123'456'789'012'345'678));
  in.handle = {n.vector(), n.vector(), n.quaternion(), n.vector(), {true, false, true, false}, false, false};
  in.requests = {true, false, true, MotionMode::kRate, -0.0, -3, true, false, true};
  in.last_heard = Time(Duration(0));
  in.peer_restarts = 2;
  in.taken = true;
  in.rtt_s = 0.0;
  in.may_send = false;
  in.overdue_ticks = 1ULL << 59;
  expect_kept<recording::MasterInput>(in);
  recording::MasterInput recorded;
  write(in, recorded);
  const MasterInput back = read(recorded);
  EXPECT_EQ(back.now, in.now);
  EXPECT_EQ(back.last_heard, in.last_heard);
  EXPECT_EQ(back.rtt_s, in.rtt_s);
  EXPECT_EQ(back.overdue_ticks, in.overdue_ticks);
  EXPECT_EQ(back.requests.grip, std::optional(false));
  EXPECT_TRUE(back.requests.turns_gripper);
  EXPECT_EQ(back.requests.scale_steps, -3);
  EXPECT_TRUE(back.handle.buttons.mode && back.handle.buttons.scale_down && !back.handle.buttons.clutch);
  expect_kept<recording::MasterInput>(MasterInput{});
  write(MasterInput{}, recorded = {});
  EXPECT_FALSE(read(recorded).last_heard);
  EXPECT_FALSE(read(recorded).requests.mode);
  EXPECT_TRUE(read(recorded).may_send);
}

TEST(RecordedValues, KeepEveryBitOfTheSlavesInput) {
  Numbers n;
  SlaveInput in;
  in.now = Time(Duration(5));
  for (double& joint : in.robot.joint_rad) joint = n.next();
  for (double& joint : in.robot.joint_rad_per_s) joint = n.next();
  in.robot.F_F_W = n.wrench();
  in.robot.ok = false;
  in.robot.load = true;
  in.last_heard = Time(Duration(-1));
  in.peer_session_count = 4;
  in.taken = in.stop = true;
  in.send_hz = n.next();
  in.rejected = 1ULL << 60;
  in.late_ticks = 6;
  in.up_loss = n.next();
  in.up_jitter_s = n.next();
  in.may_send = false;
  in.overdue_ticks = 7;
  expect_kept<recording::SlaveInput>(in);
  recording::SlaveInput recorded;
  write(in, recorded);
  const SlaveInput back = read(recorded);
  EXPECT_EQ(back.rejected, in.rejected);
  EXPECT_EQ(back.overdue_ticks, 7U);
  EXPECT_EQ(back.last_heard, in.last_heard);
  EXPECT_TRUE(back.taken && back.stop && back.robot.load && !back.robot.ok && !back.may_send);
  expect_kept<recording::SlaveInput>(SlaveInput{});
}

TEST(RecordedValues, RefuseWhatNoStructCanHold) {
  recording::MotionCommand command;
  command.set_mode(static_cast<recording::Mode>(7));
  EXPECT_THROW((void)read(command), RecordingError);
}

TEST(RecordedValues, CausesHaveTheNumbersAndNamesOfTheTable) {
  const auto* recorded = recording::Cause_descriptor();
  ASSERT_EQ(recorded->value_count(), static_cast<int>(HoldCause::kCount));
  for (int i = 1; i < recorded->value_count(); ++i) {
    std::string name = recorded->value(i)->name();
    for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_EQ(recorded->value(i)->number(), i);
    EXPECT_EQ(name, text_of(static_cast<HoldCause>(i)).name);
  }
}

}  // namespace
}  // namespace longreach::recorded_values_test
