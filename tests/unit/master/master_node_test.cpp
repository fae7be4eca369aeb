#include "master/master_node.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/random.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "master/config/rendering_config.hpp"
#include "master/simulation/simulated_devices.hpp"
#include "tests/support/allocations.hpp"

namespace longreach::master_node_test {
namespace {

/// A master in the hand of nobody, with a slave made of reports.
struct Bench {
  explicit Bench(const MasterConfig& c = {}) : config(c), node(config) { receive(); }

  void receive() {
    in.last_heard = in.now;
    in.telemetry = {};
  }
  MasterOutput tick(const StiffnessReport* report = nullptr) {
    in.now += std::chrono::milliseconds(1);
    in.last_heard = in.now;
    if (report) {
      received.sequence += 1;
      received.message = *report;
      in.reports = {&received, 1};
    } else {
      in.reports = {};
    }
    const MasterOutput out = node.step(in);
    in.requests = {};
    return out;
  }
  StiffnessReport engaged_report() const {
    return {.engagement = node.view().engagement, .state = SafetyState::kEngaged};
  }
  void engage() {
    in.requests.engage = true;
    tick();
    const StiffnessReport report = engaged_report();
    tick(&report);
    tick();
    ASSERT_TRUE(node.engaged());
  }
  StiffnessReport contact(double k, double sequence) const {
    StiffnessReport r = engaged_report();
    r.translation.surfaces[0] = {
        .normal = -Vector3::UnitX(), .stiffness = k, .touch_sequence = sequence, .touch = 1, .pressed = true};
    return r;
  }

  MasterConfig config;
  MasterNode node;
  MasterInput in{};
  Received<StiffnessReport> received{};
};

TEST(MasterNode, SendsAtItsRateWithSequencesFromOne) {
  Bench b;
  std::uint64_t expected = 0;
  for (int i = 0; i < 1000; ++i) {
    const MasterOutput out = b.tick();
    if (out.command) {
      EXPECT_EQ(out.sequence, ++expected);
    }
  }
  EXPECT_NEAR(static_cast<double>(expected), 300.0, 1.0);
}

/// What comes of a handle that is turned by 0.3 rad, in an engagement.
struct Turned {
  double goal_rad = 0.0, moment_nm = 0.0;
};
Turned turned(bool turns, MotionMode mode, double behind_rad = 0.0) {
  MasterConfig config;
  config.device.turns = turns;
  config.mapping.mode = mode;
  Bench b(config);
  b.engage();
  Turned most;
  for (int i = 0; i < 1000; ++i) {
    const double angle = std::min(0.3, 1e-3 * i);
    b.in.handle.q_MH = exp_rotation(Vector3(0.0, 0.0, angle));
    b.in.handle.angular_rad_per_s = Vector3(0.0, 0.0, angle < 0.3 ? 1.0 : 0.0);
    StiffnessReport r = b.engaged_report();
    r.rotation.surfaces[0] = {
        .normal = -Vector3::UnitZ(), .stiffness = 2.0, .touch_sequence = 1.0, .touch = 1, .pressed = true};
    if (behind_rad > 0.0) r.rotation.surfaces[0].touch_sequence = 0.0;
    r.rotation.surfaces[0].offset = behind_rad;
    const MasterOutput out = b.tick(i % 100 == 50 ? &r : nullptr);
    most.goal_rad = std::max(most.goal_rad, b.node.view().goal_rad.norm());
    most.moment_nm = std::max(most.moment_nm, out.F_H_M.moment.norm());
  }
  return most;
}

// As Omega.3 and Falcon, whose adapters may tell any orientation.
TEST(MasterNode, KeepsTheOrientationForADeviceThatTurnsNothing) {
  for (const MotionMode mode : {MotionMode::kPosition, MotionMode::kRate}) {
    const Turned can = turned(true, mode), cannot = turned(false, mode);
    EXPECT_GT(can.goal_rad, 0.01);
    EXPECT_GT(can.moment_nm, 0.01);
    EXPECT_EQ(cannot.goal_rad, 0.0);
    EXPECT_EQ(cannot.moment_nm, 0.0);
  }
  // An engagement that begins behind a stop.
  EXPECT_GT(turned(true, MotionMode::kPosition, 0.1).moment_nm, 0.01);
  EXPECT_EQ(turned(false, MotionMode::kPosition, 0.1).moment_nm, 0.0);
  MasterConfig config;
  config.device.turns = false;
  Bench b(config);
  b.in.handle.q_MH.coeffs().setZero();  // an adapter that leaves it out
  b.engage();
}

TEST(MasterNode, CommandsNothingBeforeTheSlaveConfirms) {
  Bench b;
  b.in.requests.engage = true;
  for (int i = 0; i < 500; ++i) {
    b.in.handle.p_MH.x() += 1e-5;
    const MasterOutput out = b.tick();
    if (out.command) {
      EXPECT_TRUE(out.command->position_m.isZero(0.0));
    }
  }
}

TEST(MasterNode, FeelsTheReportedStiffnessWhereTheTouchWas) {
  Bench b;
  b.engage();
  b.in.requests.scale = 0.5;
  std::uint64_t touch = 0;
  for (int i = 0; i < 1000; ++i) {  // 10 mm forward at 10 mm/s, the surface at 5 mm of the handle
    b.in.handle.p_MH.x() = 1e-5 * i;
    const MasterOutput out = b.tick();
    if (out.command && i <= 500) touch = out.sequence;
  }
  const StiffnessReport report = b.contact(1000.0, static_cast<double>(touch));
  b.tick(&report);
  EXPECT_LT(b.node.view().spring_force_n.norm(), 0.04) << "learnt late: grows by a ramp";
  EXPECT_TRUE(b.node.view().surface_known);
  for (int i = 1000; i > 0; --i) {  // back out, the anchor follows
    b.in.handle.p_MH.x() = 1e-5 * i;
    b.tick();
  }
  for (int i = 0; i <= 700; ++i) {  // and in again: 2 mm behind the surface
    b.in.handle.p_MH.x() = 1e-5 * i;
    b.tick();
  }
  EXPECT_NEAR(b.node.view().spring_force_n.x(), -2.0, 0.06);
  EXPECT_NEAR(b.node.view().stiffness_n_per_m, 1000.0, 1e-9);
}

TEST(MasterNode, AppliesScaleStepsOnMultiplesOfATwentieth) {
  Bench b;
  b.in.requests.scale = 0.81;
  b.tick();
  b.in.requests.scale_steps = 1;
  b.tick();
  EXPECT_NEAR(b.node.view().scale, 0.85, 1e-12);
  b.in.requests.scale_steps = -100;
  b.tick();
  EXPECT_NEAR(b.node.view().scale, 0.05, 1e-12);
  b.in.requests.scale = 7.0;
  b.tick();
  EXPECT_NEAR(b.node.view().scale, 0.05, 1e-12);
  EXPECT_EQ(b.node.view().rejected_values, 1U);
}

TEST(MasterNode, FadesTheContactWhenTheSlaveFallsSilent) {
  Bench b;
  b.engage();
  std::uint64_t touch = 0;
  for (int i = 0; i < 200; ++i) {
    b.in.handle.p_MH.x() = 1e-5 * i;
    const MasterOutput out = b.tick();
    if (out.command) touch = out.sequence;
  }
  const StiffnessReport report = b.contact(2000.0, static_cast<double>(touch));
  b.tick(&report);
  for (int i = 200; i < 400; ++i) {
    b.in.handle.p_MH.x() = 1e-5 * i;
    b.tick();
  }
  EXPECT_GT(b.node.view().spring_force_n.norm(), 2.0);
  b.in.reports = {};
  for (int i = 0; i < 2500; ++i) {  // silence: last_heard stays
    b.in.now += std::chrono::milliseconds(1);
    b.node.step(b.in);
  }
  EXPECT_EQ(b.node.view().state, SafetyState::kHolding);
  EXPECT_LT(b.node.view().spring_force_n.norm(), 0.01);
}

TEST(MasterNode, ShowsNoSpringThatIsNotFelt) {
  Bench b;
  b.engage();
  b.in.requests.scale = 1.0;
  std::uint64_t touch = 0;
  for (int i = 0; i < 400; ++i) {
    b.in.handle.p_MH.x() = 1e-5 * i;
    const StiffnessReport report = b.contact(2000.0, static_cast<double>(touch));
    const MasterOutput out = b.tick(i == 200 ? &report : nullptr);
    if (out.command && i < 200) touch = out.sequence;
  }
  ASSERT_GT(b.node.view().spring_force_n.norm(), 2.0);
  b.in.requests.stop = true;
  for (int i = 0; i < 100; ++i) b.tick();
  EXPECT_EQ(b.node.view().state, SafetyState::kStopped);
  EXPECT_EQ(b.node.view().spring_force_n.norm(), 0.0);
  EXPECT_EQ(b.node.view().stiffness_n_per_m, 0.0);
}

TEST(MasterNode, TellsASilenceThatIsOverFromOneThatIsNot) {
  Bench b;
  b.engage();
  for (int i = 0; i < 3000; ++i) {
    b.in.now += std::chrono::milliseconds(1);
    b.node.step(b.in);
  }
  EXPECT_EQ(b.node.view().cause, HoldCause::kLinkSilent);
  EXPECT_TRUE(b.node.view().silent);
  for (int i = 0; i < 3000; ++i) b.tick();
  EXPECT_EQ(b.node.view().cause, HoldCause::kLinkSilent);
  EXPECT_FALSE(b.node.view().silent);
  EXPECT_FALSE(b.node.view().resumes) << "too long ago";
  EXPECT_NEAR(b.node.view().hold_silence_s, 3.0, 0.01);
}

TEST(MasterNode, CountsTheAgeOfTheTelemetryItShows) {
  Bench b;
  Received<Telemetry> news{};
  b.in.now += std::chrono::milliseconds(1);
  b.in.last_heard = b.in.now;
  b.in.telemetry = {&news, 1};
  b.node.step(b.in);
  EXPECT_EQ(b.node.view().far_age_s, 0.0);
  b.in.telemetry = {};
  for (int i = 0; i < 700; ++i) b.tick();  // reports come, telemetry does not
  EXPECT_NEAR(b.node.view().far_age_s, 0.7, 1e-9);
}

TEST(MasterNode, RampsTheWrenchAwayOnStop) {
  Bench b;
  b.engage();
  b.in.requests.mode = MotionMode::kRate;
  b.tick();
  for (int i = 1; i <= 20; ++i) b.in.handle.p_MH.x() = 1e-3 * i, b.tick();
  EXPECT_GT(b.tick().F_H_M.force.norm(), 0.5);
  b.in.requests.stop = true;
  b.tick();
  for (int i = 0; i < 55; ++i) b.tick();
  EXPECT_EQ(b.tick().F_H_M.force.norm(), 0.0);
}

/// Hostile reports, a released hand, every seed: the wrench stays finite and limited, the port passive.
TEST(MasterNode, StaysPassiveAndLimitedUnderHostileReports) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Bench b;
    SimulatedDevices handle(DeviceConfig{});
    b.in.handle = handle.read(b.in.now);
    b.engage();
    for (int i = 0; i < 5000; ++i) {
      HandTarget target;
      target.position_m.x() = 0.02 * std::sin(0.002 * i);
      target.grip = random.chance(0.5) ? Grip::kLight : Grip::kReleased;
      handle.set_target(target);
      b.in.handle = handle.read(b.in.now + std::chrono::milliseconds(1));
      StiffnessReport report =
          b.contact(std::exp(random.uniform(-10.0, 25.0)), random.uniform(1.0, 0.2 * i + 1.0));
      ReportedSurface& surface = report.translation.surfaces[0];
      if (random.chance(0.1)) surface.stiffness = random.chance(0.5) ? std::nan("") : HUGE_VAL;
      if (random.chance(0.1)) surface.stiffness = -surface.stiffness;
      if (random.chance(0.1)) surface.foot = std::exp(random.uniform(-12.0, 0.0));
      if (random.chance(0.1)) surface.normal = -surface.normal;
      if (random.chance(0.1)) surface.normal.y() = random.normal();
      if (random.chance(0.1)) surface.touch_sequence = random.chance(0.5) ? std::nan("") : 1e300;
      if (random.chance(0.1)) surface.touch_sequence = 0.0, surface.offset = 0.1 * random.normal();
      if (random.chance(0.1)) surface.pressed = false;
      const MasterOutput out = random.chance(0.5) ? b.tick(&report) : b.tick();
      handle.write(out.F_H_M);
      ASSERT_TRUE(out.F_H_M.force.allFinite() && out.F_H_M.moment.allFinite())
          << "seed " << seed << " tick " << i;
      ASSERT_LE(out.F_H_M.force.norm(), b.config.rendering.force_max_n + 1e-9);
    }
    EXPECT_GE(b.node.view().port_energy_min_j, -returned_most_j()) << "seed " << seed;
    EXPECT_LE(b.node.view().energy_drawdown_j, 1e-3) << "seed " << seed;
  }
}

TEST(MasterNode, NaiveLawFailsWhereOursDoesNot) {
  const NaiveLaw naive;
  Bench b;
  b.node.render_by(&naive);
  SimulatedDevices handle(DeviceConfig{});
  b.in.handle = handle.read(b.in.now);
  b.engage();
  std::uint64_t touch = 0;
  for (int i = 0; i < 2000; ++i) {
    handle.set_target({.position_m = {1e-5 * i, 0.0, 0.0}});
    b.in.handle = handle.read(b.in.now + std::chrono::milliseconds(1));
    const MasterOutput out = b.tick();
    if (out.command && i < 500) touch = out.sequence;
    handle.write(out.F_H_M);
  }
  const StiffnessReport report = b.contact(5000.0, static_cast<double>(touch));
  for (int i = 0; i < 500; ++i) {
    b.in.handle = handle.read(b.in.now + std::chrono::milliseconds(1));
    const MasterOutput out = i == 0 ? b.tick(&report) : b.tick();
    handle.write(out.F_H_M);
  }
  EXPECT_LT(b.node.view().port_energy_min_j, -0.05);
}

TEST(MasterNode, SurvivesADeviceThatReportsNonsense) {
  Bench b;
  b.engage();
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300, std::numeric_limits<double>::denorm_min()}) {
    b.in.handle.p_MH.x() = bad;
    b.in.handle.velocity_m_per_s.y() = bad;
    const MasterOutput out = b.tick();
    EXPECT_TRUE(out.F_H_M.force.allFinite());
    EXPECT_LE(out.F_H_M.force.norm(), b.config.rendering.force_max_n + 1e-9);
    EXPECT_TRUE(b.node.view().goal_m.allFinite());
  }
}

TEST(MasterNode, AllocatesNothingInAStepWithTheDevicesThatItRuns) {
  Bench b;
  SimulatedDevices devices(DeviceConfig{});
  b.in.handle = devices.read(b.in.now);
  b.engage();
  const StiffnessReport report = b.contact(1000.0, 3.0);
  test::count_allocations(true);
  for (int i = 0; i < 2000; ++i) {
    HandTarget target{.position_m = {1e-5 * (i % 1000), 0.0, 0.0},
                      .rotation_rad = {0.0, 1e-4 * (i % 1000), 0.0}};
    target.grip = i % 500 < 400 ? Grip::kLight : Grip::kReleased;
    devices.set_target(target);
    b.in.handle = devices.read(b.in.now + std::chrono::milliseconds(1));
    devices.write(b.tick(i % 100 == 0 ? &report : nullptr).F_H_M);
  }
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
}

TEST(MasterNode, TakesTheButtonsOfTheDeviceWhenTheyGoDown) {
  Bench b;
  b.engage();
  const double scale = b.node.view().scale;
  for (int i = 0; i < 20; ++i) b.tick();
  b.in.handle.buttons = {.mode = true, .scale_up = true, .clutch = true};
  for (int i = 0; i < 5; ++i) b.tick();  // held: once, but for the clutch
  EXPECT_EQ(b.node.view().mode, MotionMode::kRate);
  EXPECT_NEAR(b.node.view().scale, scale + 0.05, 1e-12);
  EXPECT_TRUE(b.node.view().clutched);
  b.in.handle.buttons = {};
  for (int i = 0; i < 20; ++i) b.tick();
  EXPECT_FALSE(b.node.view().clutched);
  b.in.handle.buttons = {.mode = true, .scale_down = true};
  b.tick();
  EXPECT_EQ(b.node.view().mode, MotionMode::kPosition);
  EXPECT_NEAR(b.node.view().scale, scale, 1e-12);
}

TEST(MasterNode, MovesTheGoalByNothingWhenTheHandleIsLetGo) {
  for (const MotionMode mode : {MotionMode::kRate, MotionMode::kPosition}) {
    Bench b;
    SimulatedDevices devices(DeviceConfig{});
    b.in.handle = devices.read(b.in.now);
    b.engage();
    b.in.requests.mode = mode;
    const auto run = [&](const HandTarget& target, int ticks) {
      for (int i = 0; i < ticks; ++i) {
        devices.set_target(target);
        b.in.handle = devices.read(b.in.now + std::chrono::milliseconds(1));
        devices.write(b.tick().F_H_M);
      }
    };
    run({.position_m = {0.03, 0.0, 0.0}, .rotation_rad = {0.0, 0.2, 0.0}, .grip = Grip::kFirm}, 1000);
    const Vector3 goal = b.node.view().goal_m;
    const Vector3 turn = b.node.view().goal_rad;
    EXPECT_GT(goal.norm(), 1e-3);
    run({.grip = Grip::kReleased}, 3000);
    EXPECT_LT(devices.delta().position_m().norm(), 3e-3);  // it has gone home
    EXPECT_EQ((b.node.view().goal_m - goal).norm(), 0.0);
    EXPECT_EQ((b.node.view().goal_rad - turn).norm(), 0.0);
    run({.grip = Grip::kLight}, 10);  // taken up again
    EXPECT_LT((b.node.view().goal_m - goal).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace longreach::master_node_test
