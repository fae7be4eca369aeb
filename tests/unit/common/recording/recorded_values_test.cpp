// What is recorded comes back bit for bit: a replay lives of it.
#include "common/recording/recorded_values.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cctype>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "master/master_node.hpp"
#include "proto/options.pb.h"
#include "slave/slave_node.hpp"

namespace longreach::recorded_values_test {
namespace {

/// Gives each field of a struct another value: of every kind there is, or none that a message leaves out.
class Filler {
 public:
  explicit Filler(bool of_every_kind) : of_every_kind_(of_every_kind) {}

  void operator()(const char* /*name*/, double& v) { v = next(); }
  void operator()(const char* /*name*/, bool& v) { v = !of_every_kind_ || ++count_ % 2 == 0; }
  void operator()(const char* /*name*/, int& v) { v = -++count_; }
  void operator()(const char* /*name*/, std::uint32_t& v) {
    v = 4'000'000'000U + static_cast<std::uint32_t>(++count_);
  }
  void operator()(const char* /*name*/, std::uint64_t& v) {
    v = (1ULL << 63) + static_cast<std::uint64_t>(++count_);
  }
  void operator()(const char* /*name*/, Time& v) {
    v = Time(Duration(std::numeric_limits<std::int64_t>::max() - ++count_));
  }
  void operator()(const char* /*name*/, Enum auto& v) {
    using E = std::remove_reference_t<decltype(v)>;
    v = static_cast<E>(of_every_kind_ ? ++count_ % kCountOf<E> : kCountOf<E> - 1);
  }
  void operator()(const char* /*name*/, Reason& v) { v = {HoldCause::kJointOutside, 5, next(), next()}; }
  void operator()(const char* /*name*/, Section auto& v) { visit_fields(*this, v); }
  template <class T>
  void operator()(const char* name, std::optional<T>& v) {
    (*this)(name, v.emplace());
  }

 private:
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
    return of_every_kind_ && count_ % 3 == 0
               ? special[static_cast<std::size_t>(count_ / 3) % std::size(special)]
               : 1.25 * count_ + 1e-9;
  }

  bool of_every_kind_;
  int count_ = 0;
};

template <class S>
S filled(bool of_every_kind = true) {
  S value;
  Filler filler(of_every_kind);
  visit_fields(filler, value);
  return value;
}

/// The fields of the schema that a message with all recorded values lacks, in nested messages, too.
std::string missing(const google::protobuf::Message& message) {
  std::string names;
  const auto& type = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const auto* field = type.field(i);
    const auto& options = field->options();
    if (options.GetExtension(proto::unused) || options.GetExtension(proto::shown)) continue;
    if (!reflection.HasField(message, field)) {
      names += field->full_name() + " ";
    } else if (field->message_type() != nullptr) {
      names += missing(reflection.GetMessage(message, field));
    }
  }
  return names;
}

/// Every field of the schema is recorded, and what is read from the bytes gives the same bytes again.
template <class Recorded, class S>
void expect_kept() {
  Recorded whole, first, parsed, second;
  to_message(filled<S>(false), whole);
  EXPECT_EQ(missing(whole), "");
  to_message(filled<S>(), first);
  const std::string bytes = first.SerializeAsString();
  EXPECT_TRUE(parsed.ParseFromString(bytes));
  to_message(from_recorded<S>(parsed), second);
  EXPECT_TRUE(second.SerializeAsString() == bytes) << first.DebugString() << second.DebugString();
}

TEST(RecordedValues, KeepEveryBit) {
  expect_kept<recording::MotionCommand, MotionCommand>();
  expect_kept<recording::StiffnessReport, StiffnessReport>();
  expect_kept<recording::Telemetry, Telemetry>();
  expect_kept<recording::BodyPoses, BodyPoses>();
  expect_kept<recording::MasterInput, MasterTickInput>();
  expect_kept<recording::MasterOutput, MasterOutput>();
  expect_kept<recording::MasterView, MasterView>();
  expect_kept<recording::SlaveInput, SlaveTickInput>();
  expect_kept<recording::SlaveOutput, SlaveOutput>();
  expect_kept<recording::SlaveView, SlaveView>();
}

TEST(RecordedValues, WhatIsOnlyDisplayedIsNotRecorded) {
  MasterView view;
  view.grip = true;
  view.far.engagement = 3;
  view.hold_silence_s = 1.0;
  view.bodies.body[2].emplace();
  recording::MasterView with, without;
  to_message(view, with);
  to_message(MasterView{}, without);
  EXPECT_EQ(with.SerializeAsString(), without.SerializeAsString());
}

TEST(RecordedValues, DisplayedCausesAreWhole) {
  MasterView view;
  view.refusal = {HoldCause::kJointOutside, 5, 30.1, 2.094};
  recording::MasterView shown;
  to_shown_message(view, shown);
  EXPECT_EQ(shown.refusal().cause(), recording::JOINT_OUTSIDE);
  EXPECT_EQ(shown.refusal().joint(), 5U);
  EXPECT_EQ(shown.refusal().limit(), 2.094);
  EXPECT_FALSE(shown.has_grip());
  view.grip = false;
  to_shown_message(view, shown);
  EXPECT_TRUE(shown.has_grip() && !shown.grip());
}

TEST(RecordedValues, AbsentIsNotZero) {
  recording::MasterInput recorded;
  to_message(MasterTickInput{}, recorded);
  EXPECT_FALSE(recorded.has_last_heard_ns() || recorded.requests().has_mode() || recorded.has_rtt_s());
  MasterTickInput in = from_recorded<MasterTickInput>(recorded);
  EXPECT_FALSE(in.last_heard || in.requests.mode || in.rtt_s);
  EXPECT_TRUE(in.may_send && in.handle.held && in.handle.ok);
  in.last_heard = Time(Duration(0));
  in.requests.grip = false;
  in.rtt_s = 0.0;
  recorded.Clear();
  to_message(in, recorded);
  in = from_recorded<MasterTickInput>(recorded);
  EXPECT_EQ(in.last_heard, Time(Duration(0)));
  EXPECT_EQ(in.requests.grip, std::optional(false));
  EXPECT_EQ(in.rtt_s, 0.0);
}

TEST(RecordedValues, MembersAreTheFieldsOfTheirNames) {
  MasterTickInput in;
  in.handle.p_MH = {1.0, 2.0, 3.0};
  in.handle.buttons.clutch = true;
  recording::MasterInput recorded;
  to_message(in, recorded);
  EXPECT_EQ(recorded.handle().position_m().y(), 2.0);
  EXPECT_TRUE(recorded.handle().button_clutch() && !recorded.handle().button_mode());
  Telemetry t;
  t.gripper.holds = true;
  t.X_WE_goal.p.x() = 4.0;
  t.joint_rad[5] = 6.0;
  t.F_E_W.force.z() = 7.0;
  recording::Telemetry far;
  to_message(t, far);
  EXPECT_TRUE(far.load() && !far.gripper_closed());
  EXPECT_EQ(far.goal().position_m().x(), 4.0);
  EXPECT_EQ(far.joint_rad().joint6(), 6.0);
  EXPECT_EQ(far.wrench().force_n().z(), 7.0);
  StiffnessReport report;
  report.cause = {HoldCause::kJointOutside, 5, 30.1, 2.094};
  recording::StiffnessReport stiffness;
  to_message(report, stiffness);
  EXPECT_EQ(stiffness.cause(), recording::JOINT_OUTSIDE);
  EXPECT_EQ(stiffness.cause_place().joint(), 5U);
  SlaveView view;
  view.cause = report.cause;
  recording::SlaveView shown;
  to_message(view, shown);
  EXPECT_EQ(shown.cause(), recording::JOINT_OUTSIDE);
}

TEST(RecordedValues, ReceivedMessagesKeepTheirTimes) {
  Received<StiffnessReport> received{11,
                                     PeerTime(Duration(-5)),
                                     Time(Duration(std::numeric_limits<std::int64_t>::max())),
                                     Time(Duration(1)),
                                     Duration(7),
                                     true,
                                     filled<StiffnessReport>()};
  const auto again = [&received] {
    recording::ReceivedReport recorded;
    to_recorded(received, recorded);
    return from_recorded<StiffnessReport>(recorded);
  };
  EXPECT_EQ(again().sequence, 11U);
  EXPECT_EQ(again().sent, received.sent);
  EXPECT_EQ(again().received, received.received);
  EXPECT_EQ(again().echo_sent, received.echo_sent);
  EXPECT_EQ(again().rtt, Duration(7));
  EXPECT_TRUE(again().newest);
  EXPECT_EQ(again().message.engagement, received.message.engagement);
  received.echo_sent.reset();
  received.rtt = kNoRtt;
  EXPECT_FALSE(again().echo_sent) << "absent is not zero";
  EXPECT_EQ(again().rtt, kNoRtt);
}

TEST(RecordedValues, RefuseWhatNoStructCanHold) {
  recording::MotionCommand command;
  command.set_mode(static_cast<recording::Mode>(7));
  EXPECT_THROW((void)from_recorded<MotionCommand>(command), RecordingError);
}

TEST(RecordedValues, CausesHaveTheNamesOfTheTable) {
  const auto* recorded = recording::Cause_descriptor();
  for (int i = 1; i < recorded->value_count(); ++i) {
    std::string name = recorded->value(i)->name();
    for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_EQ(name, text_of(static_cast<HoldCause>(i)).name);
  }
}

}  // namespace
}  // namespace longreach::recorded_values_test
