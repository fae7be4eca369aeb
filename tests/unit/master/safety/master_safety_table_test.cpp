// Every state of the master's safety machine against every combination of demands, compared with a table that
// was written for this test.

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "master/safety/master_safety.hpp"

namespace longreach::master_safety_table_test {
namespace {

using State = SafetyState;
using Cause = HoldCause;
using std::chrono::milliseconds;

// How a machine came to where it is. Asking: an engagement that is not confirmed yet.
enum class Start {
  kIdle,
  kObserving,
  kAsking,
  kEngaged,
  kSilence,
  kLetGo,
  kSlaveHolds,
  kExpired,
  kStopped,
  kFault
};
constexpr std::array kStarts = {Start::kIdle,    Start::kObserving, Start::kAsking,     Start::kEngaged,
                                Start::kSilence, Start::kLetGo,     Start::kSlaveHolds, Start::kExpired,
                                Start::kStopped, Start::kFault};

enum class Slave { kSaysNothing, kEngaged, kHolding, kStopped, kFault, kOfAnotherNumber };
constexpr std::array kSlaves = {Slave::kSaysNothing, Slave::kEngaged, Slave::kHolding,
                                Slave::kStopped,     Slave::kFault,   Slave::kOfAnotherNumber};

struct Tick {
  Slave slave = Slave::kSaysNothing;
  bool heard = true;  // within silence_s
  bool device_fault = false, stop = false, engage = false, hold = false;
  bool taken = false, restarted = false, let_go = false, hand_stale = false;
  bool stalled = false, rose = false, overrun = false;
};

struct Machine {
  MasterSafety safety{
      MasterSafetyConfig{.silence_s = 0.5, .resume_s = 1.0, .presence = Presence::kHold, .presence_s = 0.3}};
  MasterSafetyInput in{};

  bool step(int ms = 1) {
    in.now += milliseconds(ms);
    const bool begun = safety.step(in);
    in.engage = in.hold = in.stop = false;
    return begun;
  }
  bool receive(int ms = 1) {
    in.last_heard = in.now + milliseconds(ms);
    return step(ms);
  }
  void slave_says(State state, Cause cause = Cause::kNone) {
    safety.on_report({.engagement = safety.engagement(), .state = state, .cause = cause});
  }
  void let_go() {
    in.held = false;
    for (int i = 0; i < 31; ++i) receive(10);
  }
};

Machine machine_at(Start start) {
  Machine m;
  m.in.now = Time{std::chrono::hours(1)};
  m.in.rtt_s = 0.1;
  m.step();
  if (start == Start::kIdle) return m;
  m.receive();
  if (start == Start::kObserving) return m;
  m.in.engage = true;
  m.receive();
  if (start == Start::kAsking) return m;
  m.slave_says(State::kEngaged);
  m.receive();
  if (start == Start::kSilence) m.step(501);
  if (start == Start::kLetGo) m.let_go();
  if (start == Start::kSlaveHolds || start == Start::kExpired)
    m.slave_says(State::kHolding, Cause::kLinkSilent);
  if (start == Start::kSlaveHolds) m.receive();
  if (start == Start::kExpired) m.receive(), m.receive(1001);
  m.in.stop = start == Start::kStopped;
  m.in.device_ok = start != Start::kFault;
  if (start == Start::kStopped || start == Start::kFault) m.receive();
  m.in.device_ok = true;
  return m;
}

struct Expected {
  State state;
  Cause cause;
  Request request;
  bool begun = false;
};

constexpr std::array<Expected, 10> kAt = {{{State::kIdle, Cause::kNone, Request::kHold},
                                           {State::kObserving, Cause::kNone, Request::kHold},
                                           {State::kObserving, Cause::kNone, Request::kEngage},
                                           {State::kEngaged, Cause::kNone, Request::kEngage},
                                           {State::kHolding, Cause::kLinkSilent, Request::kEngage},
                                           {State::kHolding, Cause::kHandleReleased, Request::kLetGo},
                                           {State::kHolding, Cause::kLinkSilent, Request::kEngage},
                                           {State::kHolding, Cause::kLinkSilent, Request::kHold},
                                           {State::kStopped, Cause::kOperator, Request::kStop},
                                           {State::kFault, Cause::kDeviceFault, Request::kHold}}};

// While one is under way or followed, asking for another changes nothing.
bool engages(const Tick& t, const Expected& at) {
  const bool rests =
      at.state != State::kEngaged && !(at.state == State::kObserving && at.request == Request::kEngage);
  return t.engage && rests && t.heard && !t.taken && !t.let_go && !t.hand_stale && !t.stalled;
}

// Up to the engagement: what wins over everything that the slave or the link may say.
bool wins(const Tick& t, const Expected& at, Expected& then) {
  const bool fault = at.state == State::kFault;
  const Request stops = t.stop || at.request == Request::kStop ? Request::kStop : Request::kHold;
  if (t.device_fault) {
    then = {State::kFault, Cause::kDeviceFault, stops};
  } else if (t.stop) {
    then = fault ? Expected{at.state, at.cause, Request::kStop}
                 : Expected{State::kStopped, Cause::kOperator, Request::kStop};
  } else if (engages(t, at)) {
    then = {State::kObserving, Cause::kNone, Request::kEngage};
  } else {
    return false;
  }
  return true;
}

Expected expected(Start start, const Tick& t) {
  const Expected at = kAt[static_cast<std::size_t>(start)];
  const bool asked = at.request == Request::kEngage || at.request == Request::kLetGo;
  const bool holding = at.state == State::kHolding;
  Expected then = at;
  if (wins(t, at, then)) return then;
  const auto hold = [&](Cause own, Request request) {
    return Expected{State::kHolding, holding ? at.cause : own, request};
  };
  // A restart forgets what the slave had said; in the start that had heard of a hold it says so still.
  Slave says = t.slave;
  if (t.restarted && says == Slave::kSaysNothing) says = Slave::kOfAnotherNumber;
  if (t.stalled) says = Slave::kOfAnotherNumber;  // likewise; what comes counts from the next tick on
  if (asked && says == Slave::kStopped && !t.restarted)
    return {State::kStopped, holding ? at.cause : Cause::kOperator, Request::kHold};
  if (asked && says == Slave::kFault && !t.restarted) return hold(Cause::kTrackingLost, Request::kHold);
  if (t.taken && (holding || at.state == State::kEngaged)) {
    const bool explains = !holding || at.cause == Cause::kLinkSilent;
    return {State::kHolding, explains ? Cause::kPreempted : at.cause, Request::kHold};
  }
  if ((asked || holding) && t.restarted) {
    const bool explains = !holding || at.cause == Cause::kLinkSilent;
    return {State::kHolding, explains ? Cause::kPeerRestarted : at.cause, Request::kHold};
  }
  if (asked && t.hold) return hold(Cause::kOperator, Request::kHold);
  if (asked && t.let_go) return hold(Cause::kHandleReleased, Request::kLetGo);
  if (asked && t.hand_stale) return hold(Cause::kHandStale, Request::kHold);
  if (asked && t.stalled) return hold(Cause::kStalled, Request::kEngage);
  if (asked && !t.heard) return hold(Cause::kLinkSilent, Request::kEngage);
  if (at.state == State::kEngaged && t.rose) return hold(Cause::kDelayRose, Request::kHold);
  if (at.state == State::kEngaged && t.overrun) return hold(Cause::kOverrun, Request::kHold);
  if (at.state == State::kEngaged && says == Slave::kHolding)
    return hold(Cause::kLinkSilent, Request::kEngage);
  const bool said_engaged = start == Start::kEngaged || start == Start::kSilence || start == Start::kLetGo;
  if (asked && (says == Slave::kEngaged || (says == Slave::kSaysNothing && said_engaged)))
    return {State::kEngaged, Cause::kNone, Request::kEngage, start == Start::kAsking};
  if (asked && holding) return {at.state, at.cause, Request::kEngage};
  if (at.state == State::kIdle && t.heard) return {State::kObserving, Cause::kNone, Request::kHold};
  return at;
}

bool apply(Machine& m, const Tick& t) {
  if (t.slave == Slave::kEngaged) m.slave_says(State::kEngaged);
  if (t.slave == Slave::kHolding) m.slave_says(State::kHolding, Cause::kLinkSilent);
  if (t.slave == Slave::kStopped) m.slave_says(State::kStopped, Cause::kOperator);
  if (t.slave == Slave::kFault) m.slave_says(State::kFault, Cause::kTrackingLost);
  if (t.slave == Slave::kOfAnotherNumber)
    m.safety.on_report({.engagement = m.safety.engagement() + 7, .state = State::kEngaged});
  m.in.held = true;
  if (t.let_go) {
    // As if away for longer than presence_s, within this tick.
    m.in.held = false;
    m.safety.configure({.silence_s = 0.5, .resume_s = 1.0, .presence = Presence::kHold, .presence_s = -1.0});
  }
  m.in.device_ok = !t.device_fault;
  m.in.stop = t.stop;
  m.in.engage = t.engage;
  m.in.hold = t.hold;
  m.in.taken = t.taken;
  m.in.hand_stale = t.hand_stale;
  if (t.stalled) m.in.stalled_since = m.in.now - milliseconds(200);
  m.in.delay_rose = t.rose;
  m.in.overrun = t.overrun;
  if (t.restarted) ++m.in.peer_restarts;
  if (t.heard) return m.receive();
  m.in.last_heard = m.in.last_heard ? std::optional<Time>(m.in.now - milliseconds(600)) : std::nullopt;
  return m.step();
}

std::string name(Start start, const Tick& t) {
  return "start " + std::to_string(static_cast<int>(start)) + " slave " +
         std::to_string(static_cast<int>(t.slave)) + " heard " + std::to_string(t.heard) + " hand stale " +
         std::to_string(t.hand_stale) + " device fault, stop, engage, hold " +
         std::to_string(t.device_fault) + std::to_string(t.stop) + std::to_string(t.engage) +
         std::to_string(t.hold) + " taken, restarted, let go " + std::to_string(t.taken) +
         std::to_string(t.restarted) + std::to_string(t.let_go) + " stalled, rose, overrun " +
         std::to_string(t.stalled) + std::to_string(t.rose) + std::to_string(t.overrun);
}

TEST(MasterSafetyTable, HoldsForEveryStateAndEveryCombinationOfDemands) {
  for (const Start start : kStarts) {
    for (const Slave slave : kSlaves) {
      for (unsigned bits = 0; bits < 4096; ++bits) {
        const auto bit = [&](unsigned n) { return (bits >> n & 1U) != 0; };
        const Tick t{slave,  bit(0), bit(1), bit(2), bit(3),  bit(4), bit(5),
                     bit(6), bit(7), bit(8), bit(9), bit(10), bit(11)};
        Machine m = machine_at(start);
        const Expected at = kAt[static_cast<std::size_t>(start)];
        ASSERT_EQ(m.safety.state(), at.state) << name(start, t);
        ASSERT_EQ(m.safety.cause(), at.cause) << name(start, t);
        ASSERT_EQ(m.safety.request(), at.request) << name(start, t);
        const std::uint32_t number = m.safety.engagement();
        const bool begun = apply(m, t);
        const Expected then = expected(start, t);
        ASSERT_EQ(m.safety.state(), then.state) << name(start, t);
        ASSERT_EQ(m.safety.cause(), then.cause) << name(start, t);
        ASSERT_EQ(m.safety.request(), then.request) << name(start, t);
        ASSERT_EQ(begun, then.begun) << name(start, t);
        const bool anew =
            then.state == State::kObserving && then.request == Request::kEngage && engages(t, at);
        ASSERT_EQ(m.safety.engagement() > number, anew) << name(start, t);
      }
    }
  }
}

TEST(MasterSafetyTable, NothingButTheOperatorEndsAHoldOfMoreThanASecond) {
  for (const Start start : {Start::kSilence, Start::kLetGo, Start::kSlaveHolds}) {
    for (const int held_ms : {900, 1100}) {
      Machine m = machine_at(start);
      for (int i = 0; i < held_ms; ++i) start == Start::kSilence ? m.step() : m.receive();
      m.in.held = true;
      m.slave_says(State::kEngaged);
      for (int i = 0; i < 100; ++i) m.receive();
      const bool soon = held_ms < 1000;
      EXPECT_EQ(m.safety.state(), soon ? State::kEngaged : State::kHolding) << static_cast<int>(start);
      EXPECT_EQ(m.safety.request(), soon ? Request::kEngage : Request::kHold) << static_cast<int>(start);
      if (soon) continue;
      for (int i = 0; i < 20000; ++i)
        m.slave_says(i % 2 == 0 ? State::kEngaged : State::kHolding), m.receive(10);
      EXPECT_EQ(m.safety.request(), Request::kHold) << static_cast<int>(start);
      m.in.engage = true;
      m.receive();
      m.slave_says(State::kEngaged);
      EXPECT_TRUE(m.receive());
    }
  }
}

TEST(MasterSafetyTable, StallStartsAtLastTickAndEndsWhenSlaveReportsIt) {
  for (const int stall_ms : {150, 990, 1010, 60000}) {
    Machine m = machine_at(Start::kEngaged);
    m.in.stalled_since = m.in.now;
    m.in.engage = true;
    m.receive(stall_ms);
    m.in.stalled_since.reset();
    EXPECT_EQ(m.safety.state(), State::kHolding) << stall_ms;
    EXPECT_EQ(m.safety.cause(), Cause::kStalled) << stall_ms;
    const bool soon = stall_ms < 1000;
    EXPECT_EQ(m.safety.request(), soon ? Request::kEngage : Request::kHold) << stall_ms;
    m.receive();
    EXPECT_EQ(m.safety.state(), State::kHolding) << "what it had said before does not count";
    m.slave_says(State::kEngaged);
    m.receive();
    EXPECT_EQ(m.safety.state(), soon ? State::kEngaged : State::kHolding) << stall_ms;
    EXPECT_EQ(m.safety.engagement(), 1U);
  }
}

TEST(MasterSafetyTable, ImpatienceBeginsNothingAnew) {
  Machine m = machine_at(Start::kAsking);
  m.in.rtt_s = 2.6;
  const Time asked = m.in.now;
  for (int i = 0; i < 16000; ++i) {
    m.in.engage = i % 2000 == 0;
    const double waited_s = to_seconds(m.in.now - asked);
    if (waited_s > 0.001 && waited_s < 2.6) {
      ASSERT_NEAR(m.safety.answer_in_s(m.in).value_or(-1.0), 2.6 - waited_s, 1e-6);
    }
    if (waited_s > 2.6) m.slave_says(State::kEngaged);
    m.receive();
    ASSERT_EQ(m.safety.engagement(), 1U) << i;
  }
  EXPECT_EQ(m.safety.state(), State::kEngaged);
  EXPECT_FALSE(m.safety.answer_in_s(m.in));
  m.in.hold = true;
  m.receive();
  m.in.engage = true;
  m.receive();
  EXPECT_EQ(m.safety.engagement(), 2U) << "held by the operator, it begins anew";
}

TEST(MasterSafetyTable, ARequestThatNobodyAnswersLapses) {
  for (const double rtt_s : {0.0, 0.6, 11.0}) {
    Machine m = machine_at(Start::kAsking);
    m.in.rtt_s = rtt_s;
    const Time asked = m.in.now;
    while (m.safety.request() == Request::kEngage && m.in.now - asked < std::chrono::minutes(2))
      m.receive(10);
    EXPECT_NEAR(to_seconds(m.in.now - asked), rtt_s + 3.0, 0.02);
    EXPECT_EQ(m.safety.state(), State::kObserving);
    EXPECT_EQ(m.safety.cause(), Cause::kUnanswered);
    m.slave_says(State::kEngaged);  // too late
    m.receive();
    EXPECT_EQ(m.safety.state(), State::kObserving);
  }
}

TEST(MasterSafetyTable, AcceptedRequestExpiresWhenSlaveCannotResume) {
  Machine m = machine_at(Start::kAsking);
  m.in.rtt_s = 2.6;
  m.slave_says(State::kHolding, Cause::kDelayRose);
  for (int i = 0; i < 990; ++i) m.receive();
  EXPECT_EQ(m.safety.request(), Request::kEngage) << "it may resume by itself";
  for (int i = 0; i < 20; ++i) m.receive();
  EXPECT_EQ(m.safety.request(), Request::kHold);
  EXPECT_EQ(m.safety.cause(), Cause::kDelayRose);
  EXPECT_TRUE(m.safety.cause_is_far());
  m.in.engage = true;
  m.receive();
  EXPECT_EQ(m.safety.engagement(), 2U);
  EXPECT_EQ(m.safety.request(), Request::kEngage);
}

TEST(MasterSafetyTable, IgnoresBriefReleaseAndDoesNotEngageWithoutHand) {
  Machine m = machine_at(Start::kEngaged);
  m.in.held = false;
  for (int i = 0; i < 290; ++i) m.receive();
  EXPECT_EQ(m.safety.state(), State::kEngaged);
  for (int i = 0; i < 20; ++i) m.receive();
  EXPECT_EQ(m.safety.state(), State::kHolding);
  EXPECT_EQ(m.safety.cause(), Cause::kHandleReleased);
  EXPECT_EQ(m.safety.request(), Request::kLetGo);
  for (int i = 0; i < 1100; ++i) m.receive();
  EXPECT_EQ(m.safety.request(), Request::kHold);
  EXPECT_TRUE(m.safety.hand_missing());
  m.in.engage = true;
  m.receive();
  EXPECT_EQ(m.safety.request(), Request::kHold);
  m.in.held = true;
  m.in.engage = true;
  m.receive();
  EXPECT_EQ(m.safety.request(), Request::kEngage);
}

TEST(MasterSafetyTable, WithoutThePresenceRuleAHandThatIsAwayChangesNothing) {
  Machine m;
  m.safety.configure({.silence_s = 0.5, .resume_s = 1.0});
  m.in.now = Time{std::chrono::hours(1)};
  m.in.held = false;
  m.receive();
  m.in.engage = true;
  m.receive();
  m.slave_says(State::kEngaged);
  EXPECT_TRUE(m.receive());
  for (int i = 0; i < 5000; ++i) m.receive();
  EXPECT_EQ(m.safety.state(), State::kEngaged);
}

}  // namespace
}  // namespace longreach::master_safety_table_test
