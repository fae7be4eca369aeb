// Loops through the link: what the slave reports changes the force on the hand, the hand moves the goal, and the robot
// changes what the slave reports. A hand at rest must therefore stay at rest over every link.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/person/person_run.hpp"
#include "deploy/lab/person/person_scenes.hpp"

namespace longreach::resting_hand_test {
namespace {

constexpr double kSwing_n = 0.1, kTool_m = 2e-6;
constexpr double kMostRtt_s = 7.0;

PersonScenario pressing(double depth_m, double wall_n_per_m, double rest_s) {
  const proto::LabConfig config = configure({}, LONGREACH_DEPLOY);
  PersonScenario s;
  s.master = to_struct(config.master());
  s.slave = to_struct(config.slave());
  constexpr double kWall_m = 0.03;
  only_wall(s, kWall_m, wall_n_per_m);
  in_mode(s, MotionMode::kPosition);
  const Vector3 deep(kWall_m / s.master.mapping.scale + depth_m, 0.0, 0.0);
  s.moves = {{.to_m = deep, .wait_s = 8.0, .wait_rtt = 4.0}, {.to_m = deep, .wait_s = rest_s}};
  return s;
}

void take_link(PersonScenario& s, double rtt_s, const ImpairmentConfig& impairment) {
  s.rtt_s = rtt_s;
  s.master.link.impairment = s.slave.link.impairment = impairment;
  s.master.link.impairment.delay_s = s.slave.link.impairment.delay_s = 0.5 * rtt_s;
}

/// A drawn link, wall and grip; the handle of every third scenario is released in contact.
PersonScenario drawn(std::uint64_t seed) {
  Random random = Random(seed).child("resting hand");
  PersonScenario s = pressing(random.uniform(3e-3, 0.012),
                              std::exp(random.uniform(std::log(200.0), std::log(5000.0))), 20.0);
  s.seed = seed;
  s.grip = s.master.hand.grip = random.chance(0.5) ? Grip::kFirm : Grip::kLight;
  ImpairmentConfig link;
  link.jitter_s = random.uniform(0.0, 0.02);
  link.loss = random.uniform(0.0, 0.03);
  link.loss_burst = random.uniform(1.0, 4.0);
  take_link(s, seed % 4 == 0 ? random.uniform(0.0, 0.1) : random.uniform(0.0, kMostRtt_s), link);
  if (seed % 3 == 2)
    for (PersonMove& move : s.moves) move.let_go = &move != &s.moves.front();
  return s;
}

std::string name(const PersonScenario& s) {
  return "seed " + std::to_string(s.seed) + ", round trip " + std::to_string(s.rtt_s) + " s, loss " +
         std::to_string(s.master.link.impairment.loss) + ", " + (s.grip == Grip::kFirm ? "firm" : "light") +
         (s.moves.back().let_go ? ", released" : "");
}

TEST(RestingHand, StaysAtRestOverEveryLink) {
  int pressed = 0;
  const int count = campaign(200, 6);
  for (int seed = 1; seed <= count; ++seed) {
    const PersonScenario s = drawn(static_cast<std::uint64_t>(seed));
    const PersonSeen seen = run_person(s);
    const MoveSeen& rest = seen.move[1];
    EXPECT_LE(rest.felt_swing_n, kSwing_n) << name(s);
    EXPECT_EQ(rest.holds, 0U) << name(s);
    if (s.moves.back().let_go) continue;
    EXPECT_LE(rest.tool_span_m(), kTool_m) << name(s);
    if (rest.felt_n > 0.5 && rest.tool_n > 0.5) ++pressed;
  }
  EXPECT_GE(pressed, count / 3);
}

// In rate mode, the handle is held deflected against the wall, and the goal still moves into it.
TEST(RestingHand, StaysAtRestInRateModeOverEveryLink) {
  const int count = campaign(60, 4);
  for (int seed = 1; seed <= count; ++seed) {
    PersonScenario s = drawn(static_cast<std::uint64_t>(seed));
    in_mode(s, MotionMode::kRate);
    const Vector3 out(Random(s.seed).child("deflection").uniform(0.015, 0.045), 0.0, 0.0);
    for (PersonMove& move : s.moves) move.to_m = out, move.let_go = false;
    s.moves[0].wait_s = 20.0;
    const PersonSeen seen = run_person(s);
    const MoveSeen& rest = seen.move[1];
    EXPECT_LE(rest.felt_swing_n, kSwing_n) << name(s);
    EXPECT_GT(rest.tool_n, 0.5) << name(s);
    EXPECT_EQ(rest.holds, 0U) << name(s);
  }
}

/// Drops the telemetry above 30 Hz, which was sent at this rate during an engagement, too.
struct SparseTelemetry : FaultHooks {
  void after_slave_step(SlaveOutput& out) override {
    if (out.telemetry && (sent = !sent)) out.telemetry.reset();
  }
  bool sent = false;
};

/// Link with bursts of lost datagrams, and four minutes of rest.
MoveSeen rest_with_bursts(FaultHooks* hooks) {
  PersonScenario s = pressing(6e-3, 1000.0, 240.0);
  s.grip = s.master.hand.grip = Grip::kFirm;
  s.hooks = hooks;
  take_link(s, 0.026, {.jitter_s = 0.002, .loss = 0.04, .loss_burst = 4.0});
  return run_person(s).move[1];
}

// A burst that lasts 0.5 s causes a hold, after which the force begins from zero.
TEST(RestingHand, BurstsOfLostDatagramsDoNotMoveIt) {
  const MoveSeen rest = rest_with_bursts(nullptr);
  EXPECT_EQ(rest.holds, 0U);
  EXPECT_LE(rest.felt_swing_n, kSwing_n);
  EXPECT_GE(rest.felt_n, 1.0);
  SparseTelemetry sparse;
  const MoveSeen control = rest_with_bursts(&sparse);
  EXPECT_GT(control.holds, 0U);
  EXPECT_GT(control.felt_swing_n, kSwing_n);
}

/// Closes a loop through the link without a latch: the reported stiffness follows the commanded depth.
struct StiffnessFollowsDepth : FaultHooks {
  void after_slave_step(SlaveOutput& out) override {
    if (!out.report) return;
    ReportedSurface& s = out.report->translation.surfaces[0];
    if (s.stiffness > 0.0 && depth_m > 0.0) s.stiffness *= std::min(5.0, std::pow(depth_m / 2e-3, 4.0));
  }
  void before_slave_step(SlaveInput& in) override {
    for (const auto& command : in.commands) depth_m = command.message.position_m.x() - 0.03;
  }
  double depth_m = 0.0;
};

TEST(RestingHand, SwingsIfTheReportFollowsItsMotion) {
  PersonScenario s = pressing(6e-3, 1000.0, 20.0);
  s.grip = s.master.hand.grip = Grip::kFirm;
  take_link(s, 1.0, {});
  StiffnessFollowsDepth loop;
  s.hooks = &loop;
  EXPECT_GT(run_person(s).move[1].felt_swing_n, kSwing_n);
  s.hooks = nullptr;
  EXPECT_LE(run_person(s).move[1].felt_swing_n, kSwing_n);
}

/// Adds noise to the reported stiffness or foot, for a number of reports.
struct NoisyReports : FaultHooks {
  NoisyReports(double k_sd, double foot_sd_m) : k_sd(k_sd), foot_sd_m(foot_sd_m) {}
  void after_slave_step(SlaveOutput& out) override {
    if (!out.report || left == 0) return;
    ReportedSurface& s = out.report->translation.surfaces[0];
    if (!(s.stiffness > 0.0)) return;
    --left;
    s.stiffness *= 1.0 + k_sd * random.normal();
    s.foot = std::max(0.0, s.foot + foot_sd_m * random.normal());
  }
  double k_sd, foot_sd_m;
  int left = 240;  // a minute of reports at rest
  Random random{5};
};

TEST(RestingHand, LosesNothingToNoiseInTheReports) {
  for (const auto& [k_sd, foot_sd_m] : {std::pair{0.03, 0.0}, {0.0, 1e-4}}) {
    PersonScenario s = pressing(6e-3, 1000.0, 70.0);
    s.grip = s.master.hand.grip = Grip::kFirm;
    take_link(s, 0.1, {});
    NoisyReports noise(k_sd, foot_sd_m);
    s.hooks = &noise;
    const MoveSeen after = run_person(s).move[1];
    s.hooks = nullptr;
    const double before_n = run_person(s).move[1].felt_n;
    std::printf("noise of %.0f %% and %.2f mm: %.3f N, without it %.3f N\n", 1e2 * k_sd, 1e3 * foot_sd_m,
                after.felt_n, before_n);
    EXPECT_EQ(noise.left, 0);
    EXPECT_GE(after.felt_n, 0.95 * before_n);
    EXPECT_EQ(after.holds, 0U);
  }
}

}  // namespace
}  // namespace longreach::resting_hand_test
