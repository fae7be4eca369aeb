// A relay that holds authentic datagrams back, and an operator who cannot wait; in virtual time.
// LONGREACH_FULL: an hour over each link.

#include <gtest/gtest.h>

#include <deque>

#include "deploy/lab/campaign_size.hpp"
#include "tests/loop/clocks_bench.hpp"

namespace longreach::clocks::delay_attack_test {
namespace {

using State = SafetyState;
using Cause = HoldCause;

/// A relay on the wire: holds what goes either way back for as long as it is told, in order.
class Relay : public FaultHooks {
 public:
  explicit Relay(Laboratory& lab) : lab_(lab) { lab.set_fault_hooks(*this); }
  double up_s = 0.0, down_s = 0.0;

 private:
  struct Held {
    double due_s;
    std::vector<std::byte> bytes;
  };
  // Called after the slave's turn and after the master's: takes what the one has sent before the other reads,
  // and puts it there again when it is due.
  void on_wire(MemoryChannelPair& wire) override {
    after_slave_ = !after_slave_;
    if (after_slave_) hold(wire.a(), wire.b(), down_, down_s);
    if (!after_slave_) hold(wire.b(), wire.a(), up_, up_s);
  }
  void hold(Channel& to, Channel& from, std::deque<Held>& held, double delay_s) const {
    std::array<std::byte, kDatagramMaxBytes> buffer{};
    while (const auto size = to.receive(buffer))
      held.push_back({lab_.now_s() + delay_s, {buffer.begin(), buffer.begin() + static_cast<long>(*size)}});
    for (; !held.empty() && held.front().due_s <= lab_.now_s() + 1e-9; held.pop_front())
      from.send(held.front().bytes);
  }

  Laboratory& lab_;
  bool after_slave_ = false;
  std::deque<Held> up_, down_;
};

struct Attack {
  double up_s, down_s;
  double ramp_s;  // within this time
  bool seen;
};

TEST(Delay, ARelayThatHoldsDatagramsBackIsSeen) {
  for (const Attack& a :
       {Attack{25.0, 0.0, 50.0, true}, Attack{0.0, 25.0, 50.0, true}, Attack{2.0, 2.0, 60.0, true},
        Attack{1.5, 0.0, 5.0, true}, Attack{0.8, 0.0, 5.0, false}, Attack{0.0, 0.8, 5.0, false}}) {
    Bench bench({"profile=lab", "scene_file=scenes/free.txtpb", "safety.silence_s=2"});
    Laboratory& lab = *bench.lab;
    Relay relay(lab);
    relay.up_s = relay.down_s = 0.0005;
    lab.drive({});
    run(lab, 1.0);
    ASSERT_TRUE(engage(lab, 1.0));
    run(lab, 5.0);
    double held_at_s = 0.0;
    const double began_s = lab.now_s();
    while (lab.now_s() < began_s + a.ramp_s + 3.0) {
      const double share = std::min(1.0, (lab.now_s() - began_s) / a.ramp_s);
      relay.up_s = 0.0005 + share * a.up_s;
      relay.down_s = 0.0005 + share * a.down_s;
      lab.step();
      if (held_at_s == 0.0 && lab.slave().state != State::kEngaged) held_at_s = share * (a.up_s + a.down_s);
    }
    EXPECT_EQ(held_at_s > 0.0, a.seen) << a.up_s << ' ' << a.down_s;
    if (!a.seen) {
      EXPECT_TRUE(both(lab, State::kEngaged));
      continue;
    }
    // A round trip, which tells the delay when it began, and half a window later.
    EXPECT_LT(held_at_s, 1.0 + 1.5 * (a.up_s + a.down_s) / a.ramp_s + 0.05);
    EXPECT_TRUE(lab.slave().cause == Cause::kDelayRose || lab.master().cause == Cause::kDelayRose)
        << a.up_s << ' ' << a.down_s;
    run(lab, 30.0);
    EXPECT_TRUE(both(lab, State::kHolding)) << "nothing goes on by itself";
    // The operator accepts the delay, and is shown it.
    ASSERT_TRUE(engage(lab, 40.0)) << a.up_s << ' ' << a.down_s;
    run(lab, 2.0);
    EXPECT_NEAR(lab.master().rtt_least_s.value_or(0.0), a.up_s + a.down_s, 0.05);
    EXPECT_TRUE(both(lab, State::kEngaged));
  }
}

TEST(Delay, AStepOfTheDelayOfALinkIsNoWayBackByItself) {
  for (const bool up : {true, false}) {
    const std::string step = std::string(up ? "slave" : "master") + ".link.impairment.step_";
    Bench bench({"profile=lab", "scene_file=scenes/free.txtpb", step + "delay_s=25", step + "start_s=10",
                 step + "duration_s=1000", "master.link.impairment.delay_s=0.0005",
                 "slave.link.impairment.delay_s=0.0005"});
    Laboratory& lab = *bench.lab;
    lab.drive({});
    run(lab, 2.0);
    ASSERT_TRUE(engage(lab, 1.0));
    while (lab.slave().state == State::kEngaged && lab.now_s() < 20.0) lab.step();
    EXPECT_NE(lab.slave().state, State::kEngaged) << up;
    for (int i = 0; i < 60000; ++i) {
      lab.step();
      ASSERT_NE(lab.slave().state, State::kEngaged) << up << ' ' << i;
    }
  }
}

TEST(Delay, TheLinksThatExistAreHeldByNothing) {
  for (const char* profile :
       {"lab", "kontur", "gateway", "georelay", "analog", "moon", "moon-relay", "etsvii"}) {
    Bench bench({std::string("profile=") + profile, "scene_file=scenes/free.txtpb"});
    Laboratory& lab = *bench.lab;
    lab.drive({});
    run(lab, 10.0);
    ASSERT_TRUE(engage(lab, 10.0)) << profile;
    const double end_s = lab.now_s() + campaign(3600, 30);
    while (lab.now_s() < end_s) {
      lab.step();
      ASSERT_TRUE(lab.slave().cause != Cause::kDelayRose && lab.master().cause != Cause::kDelayRose)
          << profile;
    }
  }
}

TEST(Delay, AnImpatientOperatorEngagesOnce) {
  Bench bench({"profile=moon", "scene_file=scenes/free.txtpb"});
  Laboratory& lab = *bench.lab;
  lab.drive({});
  run(lab, 6.0);
  const double asked_s = lab.now_s();
  double engaged_s = 0.0;
  for (int i = 0; i < 16000; ++i) {
    if (i % 2000 == 0) lab.requests().engage = true;
    lab.step();
    if (engaged_s == 0.0 && both(lab, State::kEngaged)) engaged_s = lab.now_s() - asked_s;
    if (engaged_s == 0.0 && i % 100 == 50) {
      ASSERT_TRUE(lab.master().engaging);
      ASSERT_NEAR(lab.master().answer_in_s.value_or(-1.0), std::max(0.0, 2.6 - 1e-3 * i), 0.1) << i;
    }
  }
  EXPECT_GT(engaged_s, 2.5);
  EXPECT_LT(engaged_s, 3.1) << "a round trip and half a second";
  EXPECT_TRUE(both(lab, State::kEngaged));
  EXPECT_EQ(lab.slave().engagement, 1U);
  EXPECT_FALSE(lab.master().engaging);
}

}  // namespace
}  // namespace longreach::clocks::delay_attack_test
