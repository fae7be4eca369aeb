// Why an engagement that was asked for is not granted: when the operator is told, and by whom.

#include <gtest/gtest.h>

#include "master/safety/master_safety.hpp"

namespace longreach::master_safety_refusal_test {
namespace {

using Cause = HoldCause;
using std::chrono::milliseconds;

struct Machine {
  MasterSafety safety{
      MasterSafetyConfig{.silence_s = 0.5, .resume_s = 1.0, .presence = Presence::kHold, .presence_s = 0.3}};
  MasterSafetyInput in{};

  void step(int ms = 1) {
    in.now += milliseconds(ms);
    safety.step(in);
    in.engage = false;
  }
  void receive(int ms = 1) {
    in.last_heard = in.now + milliseconds(ms);
    step(ms);
  }
};

Machine observing(bool asking) {
  Machine m;
  m.in.now = Time{std::chrono::hours(1)};
  m.in.rtt_s = 0.1;
  m.receive();
  m.in.engage = asking;
  m.receive();
  return m;
}

TEST(MasterSafetyRefusal, ReportsReasonOneSecondAfterRoundTrip) {
  for (const double rtt_s : {0.0, 0.6, 11.0}) {
    for (const bool says_why : {false, true}) {
      Machine m = observing(true);
      m.in.rtt_s = rtt_s;
      const Time asked = m.in.now;
      const Reason why{Cause::kRobotMoves, 5, 0.15, 0.06};
      while (to_seconds(m.in.now - asked) < rtt_s) m.receive(10);
      EXPECT_EQ(m.safety.refusal(), Cause::kNone);
      if (says_why) m.safety.on_report({.engagement = 0, .refused = m.safety.engagement(), .refusal = why});
      while (to_seconds(m.in.now - asked) < rtt_s + 1.02) m.receive(10);
      EXPECT_TRUE(m.safety.pending()) << "it may yet be granted";
      EXPECT_EQ(m.safety.refusal(), says_why ? Cause::kRobotMoves : Cause::kUnanswered);
      EXPECT_EQ(m.safety.refusal().value, says_why ? 0.15 : 0.0);
      EXPECT_EQ(m.safety.refusal_is_far(), says_why);
      while (m.safety.pending()) m.receive(10);
      EXPECT_EQ(m.safety.cause(), says_why ? Cause::kRobotMoves : Cause::kUnanswered);
      EXPECT_EQ(m.safety.cause_is_far(), says_why);
    }
  }
}

TEST(MasterSafetyRefusal, RefusalForFaultEndsRequestAtOnce) {
  for (const Cause why : {Cause::kRobotFault, Cause::kSensorFault, Cause::kSensorConstant, Cause::kJointLimit,
                          Cause::kToolOutside, Cause::kTrackingLost, Cause::kOperator}) {
    for (const bool by_itself : {false, true}) {
      Machine m;
      m.safety.configure({.silence_s = 0.5, .resume_s = 1.0, .engage_at_start = by_itself});
      m.in.rtt_s = 0.1;
      m.in.engage = !by_itself;
      m.in.now = Time{std::chrono::hours(1)};
      m.receive();
      ASSERT_TRUE(m.safety.pending());
      m.receive(100);
      m.safety.on_report({.engagement = 0, .refused = m.safety.engagement(), .refusal = why});
      m.receive();
      EXPECT_FALSE(m.safety.pending()) << text_of(why).name;
      EXPECT_EQ(m.safety.request(), Request::kHold);
      EXPECT_EQ(m.safety.refusal(), why);
      EXPECT_TRUE(m.safety.refusal_is_far());
      // The fault ends 14 s later.
      m.safety.on_report({.engagement = 0});
      for (int i = 0; i < 6000; ++i) {
        m.receive(10);
        ASSERT_NE(m.safety.request(), Request::kEngage) << i;
      }
      m.in.engage = true;
      m.receive();
      EXPECT_TRUE(m.safety.pending()) << "a new request";
    }
  }
}

TEST(MasterSafetyRefusal, EngageAtStartRepeatsRequestForAtMost30S) {
  Machine m;
  m.safety.configure({.silence_s = 0.5, .resume_s = 1.0, .engage_at_start = true});
  m.in.rtt_s = 0.1;
  m.in.now = Time{std::chrono::hours(1)};
  for (int i = 0; i < 6000; ++i) m.step(10);  // the link starts late
  const Time first = m.in.now;
  double last_s = 0.0;
  for (int i = 0; i < 9000; ++i) {
    m.receive(10);
    if (m.safety.pending()) last_s = to_seconds(m.in.now - first);
    m.safety.on_report({.refused = m.safety.engagement(), .refusal = Cause::kSensorZeroing});
  }
  EXPECT_GT(last_s, 20.0);
  EXPECT_LT(last_s, 30.0 + 3.2);
  EXPECT_GT(m.safety.engagement(), 5U);
  EXPECT_EQ(m.safety.refusal(), Cause::kSensorZeroing);
}

TEST(MasterSafetyRefusal, ImplausibleHandleIsFaultAndRefusesEngagement) {
  for (const Cause why : {Cause::kHandleJumped, Cause::kHandleOutside}) {
    Machine m = observing(true);
    m.in.handle = {why, 0, 0.06, 0.002};
    m.receive();
    EXPECT_EQ(m.safety.state(), SafetyState::kFault);
    EXPECT_EQ(m.safety.cause(), why);
    EXPECT_EQ(m.safety.cause().value, 0.06);
    EXPECT_EQ(m.safety.request(), Request::kHold);
    m.in.engage = true;
    m.receive();
    EXPECT_EQ(m.safety.refusal(), why);
    m.in.handle = {};
    m.receive();
    EXPECT_EQ(m.safety.state(), SafetyState::kFault) << "until a new engagement";
    m.in.engage = true;
    m.receive();
    EXPECT_TRUE(m.safety.pending());
    Machine idle = observing(false);
    idle.in.handle = why;
    idle.receive();
    const bool outside = why == Cause::kHandleOutside;
    EXPECT_EQ(idle.safety.state(), outside ? SafetyState::kFault : SafetyState::kObserving);
  }
}

TEST(MasterSafetyRefusal, ARequestThatThisSideDoesNotPassOnHasItsReasonAtOnce) {
  struct Row {
    Cause why;
    void (*mark_affected)(MasterSafetyInput&);
  };
  const Row rows[] = {
      {Cause::kDeviceFault, [](MasterSafetyInput& in) { in.device_ok = false; }},
      {Cause::kPreempted, [](MasterSafetyInput& in) { in.taken = true; }},
      {Cause::kLinkSilent, [](MasterSafetyInput& in) { in.last_heard = in.now - milliseconds(600); }},
      {Cause::kHandleReleased, [](MasterSafetyInput& in) { in.held = false; }},
      {Cause::kHandStale, [](MasterSafetyInput& in) { in.hand_stale = true; }},
      {Cause::kStalled, [](MasterSafetyInput& in) { in.stalled_since = in.now; }}};
  for (const Row& row : rows) {
    Machine m = observing(false);
    row.mark_affected(m.in);
    m.in.engage = true;
    m.step();
    EXPECT_EQ(m.safety.refusal(), row.why) << text_of(row.why).name;
    EXPECT_FALSE(m.safety.refusal_is_far());
    EXPECT_FALSE(m.safety.pending());
    m.in = {.now = m.in.now, .engage = true, .rtt_s = 0.1};
    m.receive();
    EXPECT_EQ(m.safety.refusal(), Cause::kNone) << "it is asked for anew";
    EXPECT_TRUE(m.safety.pending());
  }
}

}  // namespace
}  // namespace longreach::master_safety_refusal_test
