#include "slave/safety/slave_safety.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach::slave_safety_test {
namespace {

using std::chrono::milliseconds;

// A master that sends every tick unless told otherwise.
struct Drill {
  SlaveSafety safety{SlaveSafetyConfig{}};
  SlaveSafetyInput in{};
  bool silent = false;
  double age_s = 2.6;

  Drill() {
    in.now = Time{milliseconds(1000000)};
    in.peer_session_count = 1;
  }
  bool tick(int ticks = 1) {
    bool begun = false;
    for (int i = 0; i < ticks; ++i) {
      in.now += milliseconds(1);
      in.commanded = !silent;
      if (!silent) in.last_heard = in.now;
      in.echo_sent = age_s >= 0.0 ? std::optional<Time>(in.now - from_seconds(age_s)) : std::nullopt;
      begun = safety.step(in) || begun;
    }
    return begun;
  }
  bool ask(Request request, std::uint32_t engagement) {
    in.request = request;
    in.engagement = engagement;
    return tick();
  }
  SafetyState state() const { return safety.state(); }
};

Drill engaged() {
  Drill d;
  d.ask(Request::kHold, 0);
  EXPECT_EQ(d.state(), SafetyState::kObserving);
  EXPECT_TRUE(d.ask(Request::kEngage, 1));
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
  return d;
}

// Datagrams that arrive every 102 ms, as with the power saving of Wi-Fi, and a gap timer of 100 ms.
TEST(SlaveSafety, TheThirdSilenceInTenSecondsStaysUntilEngaged) {
  const auto bursts = [](Drill& d, int count, int pause_ms) {
    for (int i = 0; i < count; ++i) {
      d.silent = true;
      d.tick(150);
      EXPECT_EQ(d.state(), SafetyState::kHolding) << i;
      d.silent = false;
      d.tick(pause_ms);
    }
  };
  Drill d = engaged();
  bursts(d, 2, 20);
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
  bursts(d, 1, 20000);
  EXPECT_EQ(d.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.false_holds(), 2U);
  EXPECT_NE(with_remedy(d.safety.cause())
                .find("3 times within 10 s, no datagram arrived for longer than "
                      "safety.gap_s (0.1 s); the datagrams probably arrive in bursts"),
            std::string::npos)
      << with_remedy(d.safety.cause());
  // A new engagement restarts the count; rare silences do not add up.
  EXPECT_TRUE(d.ask(Request::kEngage, 2));
  bursts(d, 2, 20);
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
  d.tick(10000);
  bursts(d, 5, 5000);
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
}

TEST(SlaveSafety, ARobotThatIsNotReadyIsNotEngaged) {
  Drill d;
  d.ask(Request::kHold, 0);
  d.in.unready = HoldCause::kJointLimit;
  EXPECT_FALSE(d.ask(Request::kEngage, 1));
  EXPECT_EQ(d.state(), SafetyState::kObserving);
  d.in.unready = {};
  EXPECT_TRUE(d.ask(Request::kEngage, 2));
}

TEST(SlaveSafety, IsIdleUntilTheMasterIsHeardAndAgainWhenItHasGone) {
  Drill d;
  d.silent = true;
  d.tick(10);
  EXPECT_EQ(d.state(), SafetyState::kIdle);
  d.silent = false;
  d.tick();
  EXPECT_EQ(d.state(), SafetyState::kObserving);
  d.silent = true;
  d.tick(1200);
  EXPECT_EQ(d.state(), SafetyState::kIdle);
}

TEST(SlaveSafety, SaysHowOldTheNewsIsThatTheOperatorHas) {
  Drill d;
  d.age_s = -1.0;  // no echo
  d.tick();
  EXPECT_TRUE(std::isinf(d.safety.news_age_s(d.in.now)));
  d.age_s = 2.6;
  d.tick();
  EXPECT_NEAR(d.safety.news_age_s(d.in.now), 2.6, 1e-9);
  EXPECT_NEAR(d.safety.news_age_s(d.in.now + milliseconds(50)), 2.65, 1e-9);
}

TEST(SlaveSafety, EngagesOnlyForAMasterThatHasHeardIt) {
  Drill d;
  d.age_s = -1.0;  // no echo
  EXPECT_FALSE(d.ask(Request::kEngage, 1));
  d.tick(100);
  EXPECT_EQ(d.state(), SafetyState::kObserving);
  d.age_s = 31.0;  // an echo older than the age bound
  d.tick(100);
  EXPECT_EQ(d.state(), SafetyState::kObserving);
  d.age_s = 2.6;
  EXPECT_TRUE(d.tick());
  EXPECT_EQ(d.safety.engagement(), 1U);
  EXPECT_FALSE(d.tick(100));  // the same number begins nothing anew
}

TEST(SlaveSafety, HoldsWithTheCauseOfEachDemand) {
  {
    Drill d = engaged();
    d.silent = true;
    d.tick(99);
    EXPECT_EQ(d.state(), SafetyState::kEngaged);
    d.tick(3);
    EXPECT_EQ(d.state(), SafetyState::kHolding);
    EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  }
  {
    Drill d = engaged();
    d.age_s = 30.1;
    d.tick();
    EXPECT_EQ(d.state(), SafetyState::kHolding);
    EXPECT_EQ(d.safety.cause(), HoldCause::kLinkStale);
  }
  {
    Drill d = engaged();
    d.ask(Request::kHold, 1);
    EXPECT_EQ(d.state(), SafetyState::kHolding);
    EXPECT_EQ(d.safety.cause(), HoldCause::kPeerHolds) << "the master's reason is its own";
  }
  {
    Drill d = engaged();
    ++d.in.peer_session_count;
    d.silent = true;
    d.tick();
    EXPECT_EQ(d.state(), SafetyState::kHolding);
    EXPECT_EQ(d.safety.cause(), HoldCause::kPeerRestarted);
  }
}

TEST(SlaveSafety, AgesWithoutEchoes) {
  Drill d = engaged();
  d.age_s = -1.0;  // the master lives but hears nothing of us any more
  d.tick(27000);
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
  d.tick(500);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkStale);
}

TEST(SlaveSafety, AShortSilenceEndsByItselfAndCountsAsFalseHold) {
  Drill d = engaged();
  d.silent = true;
  d.tick(900);
  EXPECT_EQ(d.state(), SafetyState::kHolding);
  d.silent = false;
  EXPECT_FALSE(d.tick());
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
  EXPECT_EQ(d.safety.cause(), HoldCause::kNone);
  EXPECT_EQ(d.safety.false_holds(), 1U);
}

TEST(SlaveSafety, ALongSilenceNeedsANewNumber) {
  Drill d = engaged();
  d.silent = true;
  d.tick(1200);
  d.silent = false;
  d.tick(100);
  EXPECT_EQ(d.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  EXPECT_EQ(d.safety.false_holds(), 0U);
  EXPECT_TRUE(d.ask(Request::kEngage, 2));
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
}

TEST(SlaveSafety, AHoldOfTheOperatorDoesNotEndByItself) {
  Drill d = engaged();
  d.ask(Request::kHold, 1);
  EXPECT_FALSE(d.ask(Request::kEngage, 1));
  d.tick(10);
  EXPECT_EQ(d.state(), SafetyState::kHolding);
  EXPECT_TRUE(d.ask(Request::kEngage, 2));
}

// The commands come a few hundred times a second, the ticks a thousand.
TEST(SlaveSafety, AStopBetweenTwoCommandsEndsWhatIsAskedForInEveryState) {
  for (const bool fault : {false, true}) {
    Drill d = engaged();
    if (fault) d.in.robot = HoldCause::kJointJumped;
    if (!fault) d.in.unready = HoldCause::kRobotMoves;
    EXPECT_FALSE(d.ask(Request::kEngage, 2)) << "asked for, and not granted";
    d.in.commanded = false;
    d.in.stop = true;
    d.safety.step(d.in);
    d.in.stop = false;
    d.in.robot = d.in.unready = {};
    EXPECT_FALSE(d.ask(Request::kEngage, 2)) << "fault " << fault;
    EXPECT_NE(d.state(), SafetyState::kEngaged);
    EXPECT_EQ(d.safety.refused(), 2U);
    EXPECT_TRUE(d.ask(Request::kEngage, 3));
  }
}

TEST(SlaveSafety, AStopIsLatchedUntilANewNumber) {
  Drill d = engaged();
  d.ask(Request::kStop, 1);
  EXPECT_EQ(d.state(), SafetyState::kStopped);
  EXPECT_EQ(d.safety.cause(), HoldCause::kOperator);
  d.ask(Request::kHold, 1);
  EXPECT_FALSE(d.ask(Request::kEngage, 1));
  d.tick(5000);
  EXPECT_EQ(d.state(), SafetyState::kStopped);
  EXPECT_TRUE(d.ask(Request::kEngage, 2));
  EXPECT_EQ(d.state(), SafetyState::kEngaged);
}

TEST(SlaveSafety, AStopOnThisSideWinsOverANewEngagement) {
  Drill d = engaged();
  d.in.stop = true;
  EXPECT_FALSE(d.ask(Request::kEngage, 2));
  EXPECT_EQ(d.state(), SafetyState::kStopped);
  d.in.stop = false;
  EXPECT_FALSE(d.tick());  // the number that met the stop is used up
  EXPECT_EQ(d.state(), SafetyState::kStopped);
  EXPECT_TRUE(d.ask(Request::kEngage, 3));
}

TEST(SlaveSafety, ARobotFaultWinsOverEverythingAndIsLatched) {
  Drill d = engaged();
  d.in.robot = HoldCause::kRobotFault;
  d.in.stop = true;
  EXPECT_FALSE(d.ask(Request::kEngage, 2));
  EXPECT_EQ(d.state(), SafetyState::kFault);
  EXPECT_EQ(d.safety.cause(), HoldCause::kRobotFault);
  d.in.stop = false;
  d.in.robot = {};
  d.ask(Request::kHold, 1);
  d.tick(100);
  EXPECT_EQ(d.state(), SafetyState::kFault);
  EXPECT_TRUE(d.ask(Request::kEngage, 3));
}

TEST(SlaveSafety, ANewSessionOfThePeerCountsFromOneAgain) {
  Drill d = engaged();
  d.ask(Request::kEngage, 7);
  ++d.in.peer_session_count;
  d.ask(Request::kHold, 0);
  EXPECT_EQ(d.state(), SafetyState::kHolding);
  EXPECT_EQ(d.safety.cause(), HoldCause::kPeerRestarted);
  EXPECT_TRUE(d.ask(Request::kEngage, 1));
}

TEST(SlaveSafety, ARestartDuringASilentHoldForbidsTheReturn) {
  Drill d = engaged();
  d.silent = true;
  d.tick(300);
  ++d.in.peer_session_count;
  d.silent = false;
  d.age_s = -1.0;
  d.tick(10);  // the new master asks for engagement 1 without having heard us
  EXPECT_EQ(d.state(), SafetyState::kHolding);
}

TEST(SlaveSafety, RefusalForFaultUsesUpTheNumber) {
  struct Case {
    HoldCause why;
    bool waits;
  };
  for (const Case& c : {Case{HoldCause::kRobotFault, false}, Case{HoldCause::kSensorFault, false},
                        Case{HoldCause::kJointLimit, false}, Case{HoldCause::kToolOutside, false},
                        Case{HoldCause::kSensorConstant, false}, Case{HoldCause::kUncommandedMotion, false},
                        Case{HoldCause::kRobotMoves, true}, Case{HoldCause::kSensorZeroing, true}}) {
    Drill d;
    d.ask(Request::kHold, 0);
    const bool robot = c.why == HoldCause::kRobotFault, sensor = c.why == HoldCause::kSensorFault;
    const bool moves = c.why == HoldCause::kUncommandedMotion;
    if (robot) d.in.robot = c.why;
    d.in.sensor_fault = sensor;
    d.in.robot_uncommanded_motion = moves;
    if (!robot && !sensor && !moves) d.in.unready = c.why;
    EXPECT_FALSE(d.ask(Request::kEngage, 1));
    EXPECT_EQ(d.safety.refused(), 1U);
    d.in.robot = d.in.unready = {};
    d.in.sensor_fault = d.in.robot_uncommanded_motion = false;
    EXPECT_EQ(d.tick(14000), c.waits) << text_of(c.why).name;
    EXPECT_EQ(d.state() == SafetyState::kEngaged, c.waits) << text_of(c.why).name;
    if (c.waits) continue;
    EXPECT_EQ(d.safety.refusal(), c.why) << "the reason is kept";
    EXPECT_TRUE(d.ask(Request::kEngage, 2)) << text_of(c.why).name;
  }
}

TEST(SlaveSafety, TheFirstCauseIsKept) {
  Drill d = engaged();
  d.silent = true;
  d.tick(2000);
  d.silent = false;
  d.ask(Request::kHold, 1);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
  d.ask(Request::kStop, 1);
  EXPECT_EQ(d.state(), SafetyState::kStopped);
  EXPECT_EQ(d.safety.cause(), HoldCause::kLinkSilent);
}

}  // namespace
}  // namespace longreach::slave_safety_test
