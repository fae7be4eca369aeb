#include "master/safety/master_safety.hpp"

#include <gtest/gtest.h>

namespace longreach::master_safety_test {
namespace {

/// Drives the machine tick by tick; the slave answers as told.
struct Driver {
  explicit Driver(const MasterSafetyConfig& config = {}) : safety(config) {}

  bool tick(double t_s) {
    in.now = Time{} + from_seconds(t_s);
    const bool begun = safety.step(in);
    in.engage = in.hold = in.stop = false;
    return begun;
  }
  void receive(double t_s) { in.last_heard = Time{} + from_seconds(t_s); }
  void slave_says(SafetyState state, HoldCause cause = HoldCause::kNone) {
    safety.on_report({.engagement = safety.engagement(), .state = state, .cause = cause});
  }
  /// Up to Engaged at t = 1 s.
  void engage() {
    receive(0.9);
    tick(0.9);
    in.engage = true;
    tick(0.95);
    slave_says(SafetyState::kEngaged);
    receive(1.0);
    ASSERT_TRUE(tick(1.0));
  }

  MasterSafety safety;
  MasterSafetyInput in{};
};

TEST(MasterSafety, IsIdleUntilTheSlaveIsHeard) {
  Driver d;
  d.tick(0.0);
  EXPECT_EQ(d.safety.state(), SafetyState::kIdle);
  d.in.engage = true;  // nobody there to engage with
  d.tick(0.1);
  EXPECT_EQ(d.safety.request(), Request::kHold);
  d.receive(0.2);
  d.tick(0.2);
  EXPECT_EQ(d.safety.state(), SafetyState::kObserving);
}

TEST(MasterSafety, EngagesOnlyWhenTheSlaveConfirmsTheNumber) {
  Driver d;
  d.receive(0.0);
  d.in.engage = true;
  d.tick(0.0);
  EXPECT_EQ(d.safety.request(), Request::kEngage);
  d.safety.on_report({.engagement = d.safety.engagement() - 1, .state = SafetyState::kEngaged});
  EXPECT_FALSE(d.tick(0.1));
  EXPECT_EQ(d.safety.state(), SafetyState::kObserving);
  d.slave_says(SafetyState::kEngaged);
  EXPECT_TRUE(d.tick(0.2));
  EXPECT_EQ(d.safety.state(), SafetyState::kEngaged);
  EXPECT_FALSE(d.tick(0.3)) << "an engagement begins once";
}

TEST(MasterSafety, HoldsOnLinkSilenceAndResumesAfterShortGap) {
  Driver d({.silence_s = 0.5, .resume_s = 1.0});
  d.engage();
  d.tick(1.49);
  EXPECT_EQ(d.safety.state(), SafetyState::kEngaged);
  d.tick(1.51);
  EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  d.receive(2.0);
  EXPECT_FALSE(d.tick(2.0)) << "the same engagement, not a new one";
  EXPECT_EQ(d.safety.state(), SafetyState::kEngaged);
  EXPECT_EQ(d.safety.false_holds(), 1U);
}

TEST(MasterSafety, NeedsANewEngagementAfterALongSilence) {
  Driver d({.silence_s = 0.5, .resume_s = 1.0});
  d.engage();
  for (double t = 1.5; t < 3.0; t += 0.01) d.tick(t);
  d.receive(3.0);
  d.tick(3.0);
  EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.request(), Request::kHold);
  d.in.engage = true;
  d.tick(3.1);
  d.slave_says(SafetyState::kEngaged);
  EXPECT_TRUE(d.tick(3.2));
}

TEST(MasterSafety, StopIsLatchedUntilANewEngagement) {
  Driver d;
  d.engage();
  d.in.stop = true;
  d.tick(1.1);
  EXPECT_EQ(d.safety.state(), SafetyState::kStopped);
  EXPECT_EQ(d.safety.request(), Request::kStop);
  d.slave_says(SafetyState::kEngaged);  // old news still under way
  d.tick(1.2);
  EXPECT_EQ(d.safety.state(), SafetyState::kStopped);
  EXPECT_EQ(d.safety.request(), Request::kStop);
}

TEST(MasterSafety, StopsBeforeItEngagesWhenBothAreAskedFor) {
  Driver d;
  d.receive(0.0);
  d.in.engage = d.in.stop = true;
  d.tick(0.0);
  EXPECT_EQ(d.safety.request(), Request::kStop);
}

TEST(MasterSafety, FollowsTheSlaveIntoItsHoldAndOutOfIt) {
  Driver d;
  d.engage();
  d.slave_says(SafetyState::kHolding, HoldCause::kLinkSilent);
  d.tick(1.1);
  EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  EXPECT_TRUE(d.safety.cause_is_far());
  d.slave_says(SafetyState::kEngaged);
  d.tick(1.2);
  EXPECT_EQ(d.safety.state(), SafetyState::kEngaged);
}

TEST(MasterSafety, EngagesASlaveThatAnotherMasterHasStopped) {
  Driver d;
  d.safety.on_report({.engagement = 5, .state = SafetyState::kStopped, .cause = HoldCause::kOperator});
  d.receive(0.0);
  d.tick(0.0);
  d.in.engage = true;
  d.tick(0.1);
  EXPECT_GT(d.safety.engagement(), 5U);
  d.tick(0.2);  // the old state is still what was heard
  EXPECT_EQ(d.safety.request(), Request::kEngage);
  d.slave_says(SafetyState::kEngaged);
  EXPECT_TRUE(d.tick(0.3));
}

TEST(MasterSafety, HoldsWhenTheSlaveRestartedAndDoesNotGoOnByItself) {
  Driver d;
  d.engage();
  d.in.peer_restarts = 1;
  d.tick(1.1);
  EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.cause(), HoldCause::kPeerRestarted);
  d.slave_says(SafetyState::kEngaged);
  d.tick(1.2);
  EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
}

TEST(MasterSafety, FaultsWithTheDevice) {
  Driver d;
  d.engage();
  d.in.device_ok = false;
  d.tick(1.1);
  EXPECT_EQ(d.safety.state(), SafetyState::kFault);
  EXPECT_EQ(d.safety.request(), Request::kHold);
  d.in.device_ok = true;
  d.tick(1.2);
  EXPECT_EQ(d.safety.state(), SafetyState::kFault) << "latched";
}

TEST(MasterSafety, SlaveFaultUsesReportedCauseElseRobotFault) {
  for (const HoldCause reported : {HoldCause::kNone, HoldCause::kSensorFault}) {
    Driver d;
    d.engage();
    d.slave_says(SafetyState::kFault, reported);
    d.tick(1.1);
    EXPECT_EQ(d.safety.state(), SafetyState::kHolding);
    EXPECT_EQ(d.safety.cause(), reported == HoldCause::kNone ? HoldCause::kRobotFault : reported);
  }
}

TEST(MasterSafety, AHoldBeforeTheFirstAnswerIsNoFalseHold) {
  Driver d({.silence_s = 0.5, .resume_s = 1.0});
  d.receive(0.0);
  d.in.engage = true;
  d.tick(0.0);
  d.tick(0.6);
  ASSERT_EQ(d.safety.state(), SafetyState::kHolding);
  d.receive(0.7);
  d.slave_says(SafetyState::kEngaged);
  EXPECT_TRUE(d.tick(0.7)) << "it begins now";
  EXPECT_EQ(d.safety.false_holds(), 0U);
}

TEST(MasterSafety, SaysWhenTheAnswerCanBeHere) {
  Driver d;
  d.receive(0.0);
  d.tick(0.0);
  d.in.rtt_s = 2.5;
  EXPECT_FALSE(d.safety.answer_in_s(d.in)) << "nobody has asked";
  d.in.engage = true;
  d.tick(0.1);
  d.receive(1.0);
  d.tick(1.1);
  EXPECT_NEAR(d.safety.answer_in_s(d.in).value_or(-1.0), 1.5, 1e-9);
  d.receive(3.0);
  d.tick(3.1);
  EXPECT_EQ(d.safety.answer_in_s(d.in), 0.0) << "it is late";
  d.in.rtt_s.reset();
  EXPECT_FALSE(d.safety.answer_in_s(d.in));
  d.in.rtt_s = 2.5;
  d.slave_says(SafetyState::kEngaged);
  d.tick(3.2);
  EXPECT_FALSE(d.safety.answer_in_s(d.in)) << "it is here";
}

TEST(MasterSafety, DoesNotEngageWithoutHandOrAfterOperatorRequest) {
  Driver d({.engage_at_start = true, .presence = Presence::kHold});
  d.in.held = false;
  d.receive(0.0);
  d.tick(0.0);
  EXPECT_EQ(d.safety.engagement(), 0U);
  d.in.held = true;
  d.tick(0.1);
  EXPECT_EQ(d.safety.engagement(), 1U);
  d.tick(0.2);
  EXPECT_EQ(d.safety.engagement(), 1U) << "once";
  Driver held({.engage_at_start = true});
  held.in.hold = true;
  held.tick(0.0);
  held.receive(0.1);
  held.tick(0.1);
  held.tick(0.2);
  EXPECT_EQ(held.safety.engagement(), 0U);
}

TEST(MasterSafety, ARobotThatIsTakenInASilenceExplainsIt) {
  Driver d({.silence_s = 0.5, .resume_s = 1.0});
  d.engage();
  d.tick(1.6);
  ASSERT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  d.in.taken = true;
  d.tick(1.7);
  EXPECT_EQ(d.safety.cause(), HoldCause::kPreempted);
  Driver other({.silence_s = 0.5, .resume_s = 1.0});
  other.engage();
  other.in.hold = true;
  other.tick(1.1);
  other.in.taken = true;
  other.tick(1.2);
  EXPECT_EQ(other.safety.cause(), HoldCause::kOperator) << "the first cause stays";
}

TEST(MasterSafety, EngagesByItselfOnceWhenConfigured) {
  Driver d({.engage_at_start = true});
  d.receive(0.0);
  d.tick(0.0);
  EXPECT_EQ(d.safety.engagement(), 1U);
  d.in.stop = true;
  d.tick(0.1);
  d.tick(0.2);
  EXPECT_EQ(d.safety.engagement(), 1U);
  EXPECT_EQ(d.safety.state(), SafetyState::kStopped);
}

}  // namespace
}  // namespace longreach::master_safety_test
