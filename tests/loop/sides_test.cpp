// What the tick of a side passes to its node besides the robot and the messages: the same code in program and laboratory.
#include <gtest/gtest.h>

#include <memory>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach::sides_test {
namespace {

Laboratory& run(Laboratory& lab, double seconds) {
  for (const double end_s = lab.now_s() + seconds; lab.now_s() < end_s;) lab.step();
  return lab;
}

std::unique_ptr<Laboratory> engaged(const std::string& profile) {
  const proto::LabConfig config =
      configure({"profile=" + profile, "scene_file=scenes/free.txtpb", "safety.engage_at_start=true"},
                LONGREACH_DEPLOY);
  auto lab = std::make_unique<Laboratory>(to_struct(config.master()), to_struct(config.slave()), 1);
  lab->drive({});
  run(*lab, 5.0);
  EXPECT_EQ(lab->slave().state, SafetyState::kEngaged);
  return lab;
}

Session session(std::uint64_t number) {
  Session session{.number = number};
  session.secret.fill(std::byte{7});
  return session;
}

TEST(Sides, AStopOnTheSlavesSideStopsIt) {
  const auto lab = engaged("lab");
  lab->stop_slave();
  EXPECT_EQ(run(*lab, 0.01).slave().state, SafetyState::kStopped);
}

TEST(Sides, TheSlaveKnowsWhetherItsMasterIsAnotherOrHasBegunAnew) {
  for (const bool taken : {true, false}) {
    const auto lab = engaged("lab");
    lab->hand_slave(session(7), taken);
    lab->hand_master(session(7));
    run(*lab, 0.1);
    EXPECT_EQ(lab->slave().state, SafetyState::kHolding);
    EXPECT_EQ(lab->slave().cause, taken ? HoldCause::kPreempted : HoldCause::kPeerRestarted);
  }
}

TEST(Sides, TheMasterKnowsItsLossesAndTheSlavesLateTicks) {
  const auto lab = engaged("lab");
  EXPECT_EQ(lab->master().far.late_ticks, 0U);
  EXPECT_EQ(lab->master().far.up_loss, 0.0);
  lab->freeze_slave(0.15);
  EXPECT_EQ(run(*lab, 0.5).master().far.late_ticks, 1U);
  lab->impair_slave({.loss = 0.2});
  EXPECT_NEAR(run(*lab, 4.0).master().far.up_loss, 0.2, 0.1);
}

}  // namespace
}  // namespace longreach::sides_test
