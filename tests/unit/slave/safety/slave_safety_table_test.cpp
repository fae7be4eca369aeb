// Every state of the slave's safety machine against every combination of demands, compared with a table that
// was written for this test; and its age bound and gap timer as tables.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "slave/safety/slave_safety.hpp"

namespace longreach::slave_safety_table_test {
namespace {

using State = SafetyState;
using Cause = HoldCause;
using std::chrono::milliseconds;

// How a machine came to where it is: engagement 1, left 50 ms ago unless it says `long ago`.
enum class Start {
  kIdle,
  kObserving,
  kEngaged,
  kSilence,
  kStall,
  kLetGo,
  kOperator,
  kSilenceLongAgo,
  kStopped,
  kFault
};
constexpr std::array kStarts = {Start::kIdle,    Start::kObserving, Start::kEngaged,  Start::kSilence,
                                Start::kStall,   Start::kLetGo,     Start::kOperator, Start::kSilenceLongAgo,
                                Start::kStopped, Start::kFault};

enum class Ask { kNothing, kHold, kEngageSame, kEngageNew, kNewWithoutEcho, kNewWithOldEcho, kStop, kLetGo };
constexpr std::array kAsks = {Ask::kNothing,        Ask::kHold,           Ask::kEngageSame, Ask::kEngageNew,
                              Ask::kNewWithoutEcho, Ask::kNewWithOldEcho, Ask::kStop,       Ask::kLetGo};

enum class Heard { kNow, kBeforeTheGap, kLongBefore };

struct Tick {
  Ask ask = Ask::kNothing;
  Heard heard = Heard::kNow;
  bool robot_fault = false, uncommanded_motion = false, tracking_lost = false, stop = false;
  int session = 0;  // 0: the same, 1: another, 2: another that has taken the robot
  bool sensor_fault = false, sensor_sign = false, force_persists = false;
  bool old_news = false;  // what the master last heard of this side is older than the bound
  bool stalled = false;   // this tick came later than the gap timer
  bool rose = false;      // the delay
  bool overrun = false;
  /// What lay there meanwhile is not followed, but for a stop.
  [[nodiscard]] Ask obeyed() const { return stalled && ask != Ask::kStop ? Ask::kNothing : ask; }
};

struct Machine {
  SlaveSafety safety{SlaveSafetyConfig{.gap_s = 0.0, .age_max_s = 30.0, .resume_s = 1.0}};
  SlaveSafetyInput in{};
  Time echo{};

  void wait(int ms) { in.now += milliseconds(ms); }
  bool say(Request request, std::uint32_t number) {
    in.commanded = true;
    in.request = request;
    in.engagement = number;
    in.last_heard = in.now;
    in.echo_sent = echo = in.now;
    const bool begun = safety.step(in);
    in.commanded = false;
    wait(1);
    return begun;
  }
};

Machine machine_at(Start start) {
  Machine m;
  m.in.now = Time{std::chrono::hours(1)};
  m.in.peer_session_count = 1;
  if (start == Start::kIdle) return m;
  m.say(Request::kHold, 0);
  if (start == Start::kObserving) return m;
  m.say(Request::kEngage, 1);
  if (start == Start::kSilence || start == Start::kSilenceLongAgo) {
    m.wait(200);
    m.safety.step(m.in);
    m.wait(start == Start::kSilence ? 50 : 1001);
  }
  if (start == Start::kStall) {
    m.in.stalled_since = m.in.now;
    m.wait(200);
    m.safety.step(m.in);
    m.in.stalled_since.reset();
    m.wait(50);
  }
  if (start == Start::kLetGo) m.say(Request::kLetGo, 1);
  if (start == Start::kOperator) m.say(Request::kHold, 1);
  if (start == Start::kStopped) m.say(Request::kStop, 1);
  if (start == Start::kFault) {
    m.in.robot = Cause::kRobotFault;
    m.safety.step(m.in);
    m.in.robot = {};
  }
  if (start == Start::kLetGo || start == Start::kOperator || start == Start::kStopped ||
      start == Start::kFault)
    m.wait(50);
  return m;
}

struct Expected {
  State state;
  Cause cause;
  bool begun = false;
};

constexpr std::array<Expected, 10> kAt = {{{State::kIdle, Cause::kNone},
                                           {State::kObserving, Cause::kNone},
                                           {State::kEngaged, Cause::kNone},
                                           {State::kHolding, Cause::kLinkSilent},
                                           {State::kHolding, Cause::kStalled},
                                           {State::kHolding, Cause::kHandleReleased},
                                           {State::kHolding, Cause::kPeerHolds},
                                           {State::kHolding, Cause::kLinkSilent},
                                           {State::kStopped, Cause::kOperator},
                                           {State::kFault, Cause::kRobotFault}}};

// What is true in this tick, in the words of the table.
struct Facts {
  bool asks_new, asks_same, asks_let_go, silent, gone, stale;
};

Facts facts(Start start, const Tick& t) {
  const Ask ask = t.obeyed();
  const bool said = ask != Ask::kNothing, other = t.session != 0;
  const bool first = start == Start::kIdle || start == Start::kObserving;  // no number is used yet
  Facts f{};
  f.silent = t.heard != Heard::kNow;
  f.gone = t.heard == Heard::kLongBefore;
  f.asks_new = !t.old_news && (ask == Ask::kEngageNew || (ask == Ask::kEngageSame && (first || other)));
  // The level holds until something else is said; a session begins with none.
  const bool kept = !said && !other;
  f.asks_same = (ask == Ask::kEngageSame && !first) ||
                (kept && (start == Start::kEngaged || start == Start::kSilence || start == Start::kStall ||
                          start == Start::kSilenceLongAgo));
  f.asks_let_go = ask == Ask::kLetGo || (kept && start == Start::kLetGo);
  const bool echoes = said && ask != Ask::kNewWithoutEcho;
  f.stale = t.old_news || (ask == Ask::kNewWithOldEcho) || (other && !echoes);
  return f;
}

Expected expected(Start start, const Tick& t) {
  const Expected at = kAt[static_cast<std::size_t>(start)];
  const Facts f = facts(start, t);
  const bool engaged = at.state == State::kEngaged, holding = at.state == State::kHolding;
  const bool stopped = at.state == State::kStopped, fault = at.state == State::kFault;
  const auto to_fault = [&](Cause own) { return Expected{State::kFault, fault ? at.cause : own}; };
  const auto to_hold = [&](Cause own) { return Expected{State::kHolding, own}; };
  if (t.robot_fault) return to_fault(Cause::kRobotFault);
  if (t.sensor_fault) return to_fault(Cause::kSensorFault);
  if (t.sensor_sign && (engaged || holding || stopped)) return to_fault(Cause::kSensorSign);
  if (t.uncommanded_motion && (holding || stopped || fault)) return to_fault(Cause::kUncommandedMotion);
  if (t.tracking_lost && (engaged || holding || stopped)) return to_fault(Cause::kTrackingLost);
  if ((t.stop || t.ask == Ask::kStop) && !fault)
    return {State::kStopped, at.cause == Cause::kNone ? Cause::kOperator : at.cause};
  if (f.asks_new && !f.silent && !t.uncommanded_motion)
    if (!fault || !(t.stop || t.ask == Ask::kStop)) return {State::kEngaged, Cause::kNone, true};
  if (t.force_persists && (engaged || holding)) return to_hold(Cause::kForcePersists);
  if (engaged) {
    if (t.session == 2) return to_hold(Cause::kPreempted);
    if (t.session == 1) return to_hold(Cause::kPeerRestarted);
    if (t.stalled) return to_hold(Cause::kStalled);
    if (f.silent) return to_hold(Cause::kLinkSilent);
    if (f.stale) return to_hold(Cause::kLinkStale);
    if (t.rose) return to_hold(Cause::kDelayRose);
    if (t.overrun) return to_hold(Cause::kOverrun);
    if (!f.asks_same && !f.asks_let_go) return to_hold(Cause::kPeerHolds);
    if (f.asks_let_go) return to_hold(Cause::kHandleReleased);
  }
  const bool passing = start == Start::kSilence || start == Start::kStall || start == Start::kLetGo;
  const bool late = t.stalled || t.rose || t.overrun;
  if (passing && t.session == 0 && !f.silent && !f.stale && !late && f.asks_same)
    return {State::kEngaged, Cause::kNone};
  if (at.state == State::kIdle && !f.silent) return {State::kObserving, Cause::kNone};
  if (at.state == State::kObserving && f.gone) return {State::kIdle, Cause::kNone};
  return at;
}

std::vector<Tick> all_ticks() {
  std::vector<Tick> all;
  for (const Ask ask : kAsks) {
    for (const Heard heard : {Heard::kNow, Heard::kBeforeTheGap, Heard::kLongBefore}) {
      if (ask != Ask::kNothing && heard != Heard::kNow) continue;  // what is said is heard
      for (unsigned bits = 0; bits < 256; ++bits) {
        for (int session = 0; session < 3; ++session) {
          const auto bit = [&](unsigned n) { return (bits >> n & 1U) != 0; };
          Tick tick{ask, heard, bit(0), bit(1), bit(2), bit(3), session};
          tick.old_news = bit(4);
          tick.stalled = bit(5);
          tick.rose = bit(6);
          tick.overrun = bit(7);
          for (unsigned sensor = 0; sensor < 4; ++sensor) {  // one of them at a time
            tick.sensor_fault = sensor == 1;
            tick.sensor_sign = sensor == 2;
            tick.force_persists = sensor == 3;
            all.push_back(tick);
          }
        }
      }
    }
  }
  return all;
}

std::string name(Start start, const Tick& t) {
  return "start " + std::to_string(static_cast<int>(start)) + " ask " +
         std::to_string(static_cast<int>(t.ask)) + " heard " + std::to_string(static_cast<int>(t.heard)) +
         " fault, uncommanded_motion, tracking_lost, stop " + std::to_string(t.robot_fault) +
         std::to_string(t.uncommanded_motion) + std::to_string(t.tracking_lost) + std::to_string(t.stop) +
         " session " + std::to_string(t.session) + " old news " + std::to_string(t.old_news) +
         " stalled, rose, overrun " + std::to_string(t.stalled) + std::to_string(t.rose) +
         std::to_string(t.overrun) + " sensor " + std::to_string(t.sensor_fault) +
         std::to_string(t.sensor_sign) + std::to_string(t.force_persists);
}

bool apply(Machine& m, const Tick& t) {
  SlaveSafetyInput& in = m.in;
  in.robot = t.robot_fault ? Cause::kRobotFault : Cause::kNone;
  in.robot_uncommanded_motion = t.uncommanded_motion;
  in.robot_tracking_lost = t.tracking_lost;
  in.sensor_fault = t.sensor_fault;
  in.sensor_sign = t.sensor_sign;
  in.force_persists = t.force_persists;
  in.stop = t.stop;
  if (t.stalled) in.stalled_since = in.now - milliseconds(200);
  in.delay_rose = t.rose;
  in.overrun = t.overrun;
  if (t.session != 0) ++in.peer_session_count;
  in.taken = t.session == 2;
  // Old news are made by time, so that what was echoed before is old, too; it passes in silence.
  const Time then = in.now;
  if (t.old_news) m.safety.configure({.gap_s = 0.0, .age_max_s = 0.0, .resume_s = 1.0});
  in.last_heard =
      t.heard == Heard::kNow ? then : then - milliseconds(t.heard == Heard::kLongBefore ? 1200 : 160);
  in.commanded = t.ask != Ask::kNothing;
  in.request = t.ask == Ask::kHold    ? Request::kHold
               : t.ask == Ask::kStop  ? Request::kStop
               : t.ask == Ask::kLetGo ? Request::kLetGo
                                      : Request::kEngage;
  const bool newer =
      t.ask == Ask::kEngageNew || t.ask == Ask::kNewWithoutEcho || t.ask == Ask::kNewWithOldEcho;
  in.engagement = newer ? 2 : 1;
  in.echo_sent = then - milliseconds(1);
  if (t.ask == Ask::kNewWithoutEcho) in.echo_sent.reset();
  if (t.ask == Ask::kNewWithOldEcho) in.echo_sent = then - std::chrono::seconds(31);
  return m.safety.step(in);
}

TEST(SlaveSafetyTable, HoldsForEveryStateAndEveryCombinationOfDemands) {
  int count = 0;
  for (const Start start : kStarts) {
    for (const Tick& t : all_ticks()) {
      Machine m = machine_at(start);
      const Expected at = kAt[static_cast<std::size_t>(start)];
      ASSERT_EQ(m.safety.state(), at.state) << name(start, t);
      ASSERT_EQ(m.safety.cause(), at.cause) << name(start, t);
      const bool begun = apply(m, t);
      const Expected then = expected(start, t);
      ASSERT_EQ(m.safety.state(), then.state) << name(start, t);
      ASSERT_EQ(m.safety.cause(), then.cause) << name(start, t);
      ASSERT_EQ(begun, then.begun) << name(start, t);
      ++count;
    }
  }
  EXPECT_EQ(count, 10 * (7 + 3) * 256 * 3 * 4);
}

// Severity alone: of two demands in one tick, the state is the more severe of what each would lead to.
TEST(SlaveSafetyTable, TheMoreSevereOfTwoDemandsWins) {
  for (const Start start : {Start::kEngaged, Start::kSilence, Start::kStopped}) {
    for (unsigned one = 0; one < 6; ++one) {
      for (unsigned two = 0; two < 6; ++two) {
        const auto with = [&](unsigned a, unsigned b) {
          Tick t;
          t.ask = a == 4 || b == 4 ? Ask::kStop : a == 5 || b == 5 ? Ask::kHold : Ask::kNothing;
          t.robot_fault = a == 0 || b == 0;
          t.uncommanded_motion = a == 1 || b == 1;
          t.tracking_lost = a == 2 || b == 2;
          t.stop = a == 3 || b == 3;
          Machine m = machine_at(start);
          apply(m, t);
          return m.safety.state();
        };
        EXPECT_EQ(with(one, two), std::max(with(one, one), with(two, two))) << one << ' ' << two;
      }
    }
  }
}

TEST(SlaveSafetyTable, OnlyANewNumberLeavesStoppedAndFaultHoweverLongItTakes) {
  for (const Start start : {Start::kStopped, Start::kFault, Start::kSilenceLongAgo, Start::kOperator}) {
    Machine m = machine_at(start);
    const State state = m.safety.state();
    for (int i = 0; i < 20000; ++i) {
      m.say(i % 3 == 0 ? Request::kHold : Request::kEngage, static_cast<std::uint32_t>(i % 2));
      ASSERT_EQ(m.safety.state(), state) << i;
    }
    EXPECT_TRUE(m.say(Request::kEngage, 2));
  }
}

TEST(SlaveSafetyTable, AStallCountsFromTheLastTickBeforeIt) {
  for (const int stall_ms : {150, 990, 1010, 60000}) {
    Machine m = machine_at(Start::kEngaged);
    m.in.stalled_since = m.in.now;
    m.wait(stall_ms);
    m.say(Request::kEngage, 2);  // lay there meanwhile
    EXPECT_EQ(m.safety.state(), State::kHolding) << stall_ms;
    m.in.stalled_since.reset();
    for (int i = 0; i < 5000; ++i) m.say(Request::kEngage, 1);
    EXPECT_EQ(m.safety.state(), stall_ms < 1000 ? State::kEngaged : State::kHolding) << stall_ms;
    EXPECT_EQ(m.safety.engagement(), 1U);
    EXPECT_TRUE(m.say(Request::kEngage, 2)) << stall_ms;
  }
}

TEST(SlaveSafetyTable, TheAgeIsThatOfTheNewestEchoOnThisClockAlone) {
  struct Row {
    double bound_s, echo_s;  // age of the echo in the last command
    int silent_commands_ms;  // commands without an echo follow for so long
    bool holds;
  };
  for (const Row& r : {Row{30.0, 0.0, 0, false}, Row{30.0, 2.6, 0, false}, Row{30.0, 29.9, 0, false},
                       Row{30.0, 29.9, 90, false}, Row{30.0, 29.9, 110, true}, Row{30.0, 30.1, 0, true},
                       Row{0.1, 0.09, 0, false}, Row{0.1, 0.11, 0, true}, Row{1000.0, 999.0, 0, false},
                       Row{1000.0, 1001.0, 0, true}, Row{5.0, 0.0, 4990, false}, Row{5.0, 0.0, 5010, true}}) {
    Machine m = machine_at(Start::kEngaged);
    m.safety.configure({.gap_s = 0.0, .age_max_s = r.bound_s, .resume_s = 1.0});
    m.in.commanded = true;
    for (int i = 0; i <= r.silent_commands_ms; ++i) {
      m.in.last_heard = m.in.now;
      m.in.echo_sent = i == 0 ? std::optional<Time>(m.in.now - from_seconds(r.echo_s)) : std::nullopt;
      m.safety.step(m.in);
      m.wait(1);
    }
    EXPECT_EQ(m.safety.state() == State::kHolding, r.holds) << r.bound_s << ' ' << r.echo_s;
    EXPECT_EQ(m.safety.cause(), r.holds ? Cause::kLinkStale : Cause::kNone);
  }
}

TEST(SlaveSafetyTable, GapTimerIsThirtySendPeriodsMinimumTenthSecond) {
  struct Row {
    double set_s, send_hz;
    int holds_after_ms;
  };
  for (const Row& r : {Row{0.0, 50.0, 600}, Row{0.0, 100.0, 300}, Row{0.0, 200.0, 150}, Row{0.0, 300.0, 100},
                       Row{0.0, 1000.0, 100}, Row{0.0, 4000.0, 100}, Row{0.02, 200.0, 20},
                       Row{2.0, 200.0, 2000}, Row{0.3, 4000.0, 300}}) {
    Machine m = machine_at(Start::kEngaged);
    m.safety.configure({.gap_s = r.set_s, .age_max_s = 30.0, .resume_s = 1.0});
    m.in.send_hz = r.send_hz;
    m.in.commanded = false;
    const Time heard = *m.in.last_heard;
    while (m.safety.state() == State::kEngaged && m.in.now - heard < std::chrono::seconds(5)) {
      m.safety.step(m.in);
      m.wait(1);
    }
    const auto after_ms = (m.in.now - heard) / milliseconds(1) - 1;  // the tick that held
    EXPECT_NEAR(static_cast<double>(after_ms), r.holds_after_ms, 1.0) << r.set_s << ' ' << r.send_hz;
  }
}

}  // namespace
}  // namespace longreach::slave_safety_table_test
