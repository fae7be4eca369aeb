// Both safety machines at work, in virtual time: one side dies, the link falls silent, the operator engages
// again and again. LONGREACH_FULL: 10,000 engagements, blackouts of up to half an hour.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::safety_test {
namespace {

using State = SafetyState;
using Cause = HoldCause;

std::unique_ptr<Laboratory> laboratory(const std::vector<std::string>& settings, std::uint64_t seed = 1) {
  const proto::LabConfig config = configure(settings, LONGREACH_DEPLOY);
  return std::make_unique<Laboratory>(to_struct(config.master()), to_struct(config.slave()), seed);
}

void run(Laboratory& lab, double seconds) {
  const double end_s = lab.now_s() + seconds - 0.5 * lab.period_s();
  while (lab.now_s() < end_s) lab.step();
}

bool both(const Laboratory& lab, State state) {
  return lab.master().state == state && lab.slave().state == state;
}

/// The script has touched the wall and presses.
std::unique_ptr<Laboratory> pressing(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"profile=lab", "safety.engage_at_start=true",
                                   "scene.material.wall.stiffness_n_per_m=2000"});
  auto lab = laboratory(settings);
  while (lab->now_s() < 120.0 && !(lab->master().spring_force_n.norm() > 1.5)) lab->step();
  run(*lab, 1.0);
  EXPECT_GT(lab->arm().true_wrench().force.norm(), 1.5);
  return lab;
}

TEST(Safety, DeadSlaveLeavesRobotAtRestAndForceFades) {
  auto lab = pressing({});
  const double k = lab->master().stiffness_n_per_m;
  ASSERT_GT(k, 500.0);
  lab->kill_slave();
  run(*lab, 0.45);
  EXPECT_EQ(lab->master().state, State::kEngaged);
  EXPECT_NEAR(lab->master().stiffness_n_per_m, k, 0.01 * k);
  run(*lab, 0.1);
  EXPECT_EQ(lab->master().state, State::kHolding);
  EXPECT_EQ(lab->master().cause, Cause::kLinkSilent);
  // The stiffness decays with 0.2 s, and with it the force, without a step.
  const double k_then = lab->master().stiffness_n_per_m;
  double force = lab->master().spring_force_n.norm(), step_n = 0.0;
  for (int i = 0; i < 1000; ++i) {
    lab->step();
    const double now_n = lab->master().spring_force_n.norm();
    step_n = std::max(step_n, std::abs(now_n - force));
    force = now_n;
    if (i == 199) {
      EXPECT_NEAR(lab->master().stiffness_n_per_m, std::exp(-1.0) * k_then, 0.05 * k_then);
    }
  }
  EXPECT_LT(lab->master().stiffness_n_per_m, 0.01 * k);
  EXPECT_LT(force, 0.05);
  EXPECT_LT(step_n, 0.2);
  EXPECT_TRUE(lab->arm().watchdog_stopped());
  EXPECT_GE(lab->master().port_energy_min_j, -returned_most_j());
}

TEST(Safety, ARobotWhoseSlaveDiesInMotionStopsByItsOwnWatchdog) {
  auto lab = laboratory({"profile=lab", "scene_file=scenes/free.txtpb", "profile=lab",
                         "safety.engage_at_start=true", "mapping.mode=RATE"});
  HandTarget target;
  lab->drive(target);
  run(*lab, 1.0);
  target.position_m = {0.05, 0.0, 0.0};
  lab->drive(target);
  while (lab->now_s() < 20.0 && !(lab->arm().true_velocity().norm() > 0.05)) lab->step();
  ASSERT_GT(lab->arm().true_velocity().norm(), 0.05);
  lab->kill_slave();
  run(*lab, 0.02 + 0.15);
  EXPECT_TRUE(lab->arm().watchdog_stopped());
  EXPECT_LT(lab->arm().true_velocity().norm(), 1e-3);
  const Vector3 at_m = lab->arm().true_pose().p;
  run(*lab, 5.0);
  EXPECT_LT((lab->arm().true_pose().p - at_m).norm(), 1e-5);
  EXPECT_EQ(lab->master().state, State::kHolding);
  EXPECT_EQ(lab->master().cause, Cause::kLinkSilent);
}

TEST(Safety, DeadMasterInContactKeepsSmallForce) {
  for (const double hold_n : {1.0, 1.4}) {
    auto lab = pressing({"command.hold_force_n=" + std::to_string(hold_n)});
    const std::uint32_t touch = lab->slave().touch;
    lab->kill_master();
    run(*lab, 0.2);
    EXPECT_EQ(lab->slave().state, State::kHolding);
    EXPECT_EQ(lab->slave().cause, Cause::kLinkSilent);
    run(*lab, 0.95);  // 1 s of hold
    for (int i = 0; i < 3000; ++i) {
      lab->step();
      ASSERT_LE(lab->arm().true_wrench().force.norm(), hold_n);
      ASSERT_GT(lab->arm().true_wrench().force.norm(), 0.5 * hold_n);
      ASSERT_TRUE(lab->slave().in_contact);
    }
    EXPECT_EQ(lab->slave().touch, touch);
    EXPECT_EQ(lab->slave().state, State::kHolding);
  }
}

/// The links as they are cut: what is sent into a cut direction is gone.
struct Cut : FaultHooks {
  bool up = false, down = false;
  void set(bool cuts_up, bool cuts_down) { up = cuts_up, down = cuts_down; }
  void on_wire(MemoryChannelPair& wire) override {
    std::array<std::byte, kDatagramMaxBytes> buffer{};
    if (up)
      while (wire.b().receive(buffer)) continue;
    if (down)
      while (wire.a().receive(buffer)) continue;
  }
};

/// Largest steps of what the slave is commanded, from tick to tick.
class Steps {
 public:
  explicit Steps(const Laboratory& lab) : lab_(lab), last_(lab.slave().X_WE_goal) {}
  void see() {
    const Pose& X = lab_.slave().X_WE_goal;
    m = std::max(m, (X.p - last_.p).norm());
    rad = std::max(rad, X.q.angularDistance(last_.q));
    last_ = X;
  }
  double m = 0.0, rad = 0.0;

 private:
  const Laboratory& lab_;
  Pose last_;
};

class Reengagement : public testing::Test {
 protected:
  static constexpr double kDelay_s = 0.01;
  Reengagement() {
    lab_->set_fault_hooks(cut_);
    lab_->drive(hand_);
  }
  /// The hand goes somewhere else, within reach.
  void move() {
    const HandTarget from = hand_;
    const Vector3 to = 0.03 * Vector3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1));
    for (int i = 1; i <= 80; ++i) {
      hand_.position_m = from.position_m + i / 80.0 * (to - from.position_m);
      lab_->drive(hand_);
      lab_->step();
    }
  }
  /// Ends the engagement in one of the ways there are. True: it may go on by itself.
  bool leave() {
    const double way = random_.uniform();
    if (way < 0.3) {
      lab_->requests().hold = true;
    } else if (way < 0.6) {
      lab_->requests().stop = true;
    } else {
      cut_.set(way<0.8, way> 0.7);
      const bool shortly = random_.chance(0.5);
      run(*lab_, shortly ? 0.2 : 1.8);
      cut_.set(false, false);
      return shortly;
    }
    return false;
  }
  /// Nothing goes on before the operator says so.
  void expect_rest(double seconds) {
    const double end_s = lab_->now_s() + seconds;
    while (lab_->now_s() < end_s) {
      lab_->step();
      ASSERT_NE(lab_->slave().state, State::kEngaged);
      ASSERT_NE(lab_->master().state, State::kEngaged);
    }
  }

  Random random_{5};
  HandTarget hand_{};
  Cut cut_{};
  std::unique_ptr<Laboratory> lab_ = laboratory(
      {"profile=lab", "scene_file=scenes/free.txtpb", "master.link.impairment.delay_s=0.01",
       "slave.link.impairment.delay_s=0.01", "playout.adaptive=false", "safety.engage_at_start=false"});
};

TEST_F(Reengagement, CommandsNoStepAndHappensByTheOperatorAlone) {
  run(*lab_, 0.5);
  const int count = campaign(10'000, 200);
  double worst_m = 0.0, worst_rad = 0.0;
  int by_themselves = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t number = lab_->slave().engagement;
    Steps steps(*lab_);
    lab_->requests().engage = true;
    for (int k = 0; k < 150; ++k) {
      lab_->step();
      steps.see();
    }
    ASSERT_TRUE(both(*lab_, State::kEngaged)) << i;
    ASSERT_EQ(lab_->slave().engagement, number + 1) << i;
    ASSERT_LE(steps.m, 1e-4) << i;
    ASSERT_LE(steps.rad, 1e-4) << i;
    worst_m = std::max(worst_m, steps.m);
    worst_rad = std::max(worst_rad, steps.rad);
    move();
    const bool may_go_on = leave();
    run(*lab_, 0.35);  // the robot comes to rest
    if (may_go_on) {
      by_themselves += both(*lab_, State::kEngaged);
      lab_->requests().hold = true;
      run(*lab_, 0.3);
    }
    expect_rest(random_.chance(0.05) ? 1.5 : 0.05);
    if (HasFatalFailure()) FAIL() << "engagement " << i;
    ASSERT_EQ(lab_->slave().limit_violations, 0U) << i;
  }
  std::printf(
      "%d engagements: steps of at most %.2e m and %.2e rad; %d short silences went on by themselves\n",
      count, worst_m, worst_rad, by_themselves);
  EXPECT_GT(by_themselves, count / 10);
}

struct Blackout {
  double delay_s;
  bool up, down;
  double seconds;
  bool goes_on;  // by itself
};

std::ostream& operator<<(std::ostream& out, const Blackout& b) {
  return out << b.seconds << " s, delay " << b.delay_s << " s" << (b.up ? ", up" : "")
             << (b.down ? ", down" : "");
}

/// Gap timer 0.1 s, silence 0.5 s, resume 1 s: a silence up to the gap is none; the slave's hold ends within
/// 1.1 s of the last command, the master's within 1.5 s of the last news.
std::vector<Blackout> blackouts() {
  std::vector<Blackout> all;
  const double longest_s = campaign(1800, 6);
  for (const double delay_s : {0.01, 1.3}) {
    for (const double s : {0.08, 0.2, 0.4, 0.45, 0.6, 0.9, 1.05, 1.25, 1.4, 1.7, 3.0, longest_s}) {
      if (delay_s > 1.0 && s != 0.08 && s != 0.9 && s != 1.25 && s != 3.0) continue;
      all.push_back({delay_s, true, true, s, s < 1.1});
      all.push_back({delay_s, true, false, s, s < 1.1});
      all.push_back({delay_s, false, true, s, s < 1.5});
    }
  }
  return all;
}

TEST(Safety, BlackoutEndsAsSpecified) {
  for (const Blackout& b : blackouts()) {
    const std::string delay = std::to_string(b.delay_s);
    auto lab =
        laboratory({"profile=lab", "scene_file=scenes/free.txtpb", "safety.engage_at_start=true",
                    "master.link.impairment.delay_s=" + delay, "slave.link.impairment.delay_s=" + delay});
    Cut cut;
    lab->set_fault_hooks(cut);
    lab->drive({});
    run(*lab, 2.0 + 6.0 * b.delay_s);
    ASSERT_TRUE(both(*lab, State::kEngaged)) << b;
    cut.set(b.up, b.down);
    const bool held = b.up && b.seconds > 0.11;
    run(*lab, b.seconds);
    cut.set(false, false);
    const bool seen = held && b.seconds > b.delay_s;
    EXPECT_EQ(lab->slave().state == State::kHolding, seen || (b.down && b.seconds > 1.6 + 2.0 * b.delay_s))
        << b;
    run(*lab, 2.0 + 4.0 * b.delay_s);
    EXPECT_EQ(both(*lab, State::kEngaged), b.goes_on) << b;
    EXPECT_EQ(both(*lab, State::kHolding), !b.goes_on) << b;
    EXPECT_EQ(lab->slave().engagement, 1U) << b;
    EXPECT_EQ(lab->slave().false_holds, held && b.goes_on ? 1U : 0U) << b;
    lab->requests().hold = true;
    run(*lab, 0.5 + 4.0 * b.delay_s);
    lab->requests().engage = true;
    run(*lab, 1.0 + 4.0 * b.delay_s);
    EXPECT_TRUE(both(*lab, State::kEngaged)) << b;
    EXPECT_EQ(lab->slave().engagement, 2U) << b;
  }
}

TEST(Safety, LostEngageRequestHasNoLaterEffect) {
  auto lab = laboratory({"profile=lab", "safety.engage_at_start=false", "scene_file=scenes/free.txtpb"});
  Cut cut;
  lab->set_fault_hooks(cut);
  run(*lab, 1.0);
  ASSERT_TRUE(both(*lab, State::kObserving));
  cut.up = true;
  lab->requests().engage = true;
  run(*lab, 10.0);
  EXPECT_EQ(lab->master().cause, Cause::kUnanswered);
  cut.up = false;
  run(*lab, 5.0);
  EXPECT_TRUE(both(*lab, State::kObserving));
}

TEST(Safety, LettingGoHoldsWhereThatIsWantedAndSoonAfterGoesOn) {
  for (const bool wanted : {false, true}) {
    for (const double away_s : {0.2, 0.9, 2.0}) {
      auto lab = laboratory({"profile=lab", "scene_file=scenes/free.txtpb", "safety.engage_at_start=true",
                             std::string("safety.presence=") + (wanted ? "HOLD" : "IGNORE")});
      HandTarget hand;
      lab->drive(hand);
      run(*lab, 2.0);
      hand.position_m = {0.02, 0.0, 0.0};
      lab->drive(hand);
      run(*lab, 2.0);
      ASSERT_TRUE(both(*lab, State::kEngaged));
      const Vector3 tool_m = lab->slave().X_WE.p;
      lab->let_go();
      run(*lab, away_s);
      const bool holds = wanted && away_s > 0.3;
      EXPECT_EQ(both(*lab, State::kHolding), holds) << away_s;
      EXPECT_EQ(lab->slave().cause, holds ? Cause::kHandleReleased : Cause::kNone);
      EXPECT_EQ(lab->master().cause, holds ? Cause::kHandleReleased : Cause::kNone);
      EXPECT_LT((lab->slave().X_WE.p - tool_m).norm(), 1e-3);
      lab->let_go(false);
      run(*lab, 1.0);
      const bool late = holds && away_s > 1.3;
      EXPECT_EQ(both(*lab, State::kEngaged), !late) << wanted << ' ' << away_s;
      EXPECT_EQ(lab->slave().engagement, 1U);
      EXPECT_EQ(lab->slave().false_holds + lab->master().false_holds, 0U);
    }
  }
}

}  // namespace
}  // namespace longreach::safety_test
