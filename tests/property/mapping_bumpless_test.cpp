// No change that the operator makes moves the goal: mode, scale, kv, clutch, letting go and taking the handle
// again, the device whose turn it is.

#include <gtest/gtest.h>

#include <array>

#include "deploy/lab/campaign_size.hpp"
#include "master/master_node.hpp"
#include "tests/property/mapping_walk.hpp"

namespace longreach::mapping_bumpless_test {
namespace {

constexpr double kNothing = 1e-12;  // m and rad

TEST(MappingProperty, EveryChangeOfModeScaleOrClutchLeavesTheGoalWhereItIs) {
  const int seeds = campaign(2000, 100);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Mapping mapping(any_mapping(random));
    MappingInput in;
    mapping.reset(in.handle);
    for (int i = 0; i < 500; ++i) {
      wander(in.handle, random, 0.1, 1.0);
      const bool rescales = random.chance(0.05), clutches = random.chance(0.05),
                 switches = random.chance(0.05);
      const bool rate = in.mode == MotionMode::kRate;
      if (rescales) in.scale = in.scale == 0.05 ? 0.8 : 0.05;
      if (clutches) in.frozen = !in.frozen;
      if (switches) in.mode = rate ? MotionMode::kPosition : MotionMode::kRate;
      const Goal before = mapping.goal();
      const Goal& after = mapping.step(in, kTick_s);
      // The scale means nothing to rate mode, which goes on.
      if (!clutches && !switches && (!rescales || rate)) continue;
      ASSERT_LE((after.position_m - before.position_m).norm(), kNothing) << "seed " << seed << " tick " << i;
      ASSERT_LE(angle_between(after.rotation, before.rotation), kNothing) << "seed " << seed << " tick " << i;
    }
  }
}

TEST(MappingProperty, TheScaleMeansNothingInRateMode) {
  const int seeds = campaign(500, 20);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const MappingConfig config = any_mapping(random);
    Mapping with_steps(config), without(config);
    MappingInput in{.mode = MotionMode::kRate};
    for (int i = 0; i < 500; ++i) {
      wander(in.handle, random, 0.1, 1.0);
      in.scale = 1.0;
      without.step(in, kTick_s);
      in.scale = twentieths(random);
      with_steps.step(in, kTick_s);
      ASSERT_EQ(with_steps.goal().position_m, without.goal().position_m) << "seed " << seed;
      ASSERT_EQ(with_steps.goal().rotation.coeffs(), without.goal().rotation.coeffs()) << "seed " << seed;
    }
  }
}

/// Largest change of the speed of the goal in a tick, while kv changes at random and the handle is held deflected, as a
/// share of the largest change of the speed that kv asks for.
struct KvStep {
  double translation = 0.0, rotation = 0.0;
};
/// `at_once`: without the ramp, for the control.
KvStep change_kv(std::uint64_t seed, bool at_once) {
  Random random(seed);
  MappingConfig config = any_mapping(random);
  config.rate_centre = RateCentre::kHandleOrigin;
  config.speed_max_m_per_s = config.speed_max_rad_per_s = 1e4;
  Mapping mapping(config);
  MappingInput in{.mode = MotionMode::kRate};
  mapping.step(in, kTick_s);
  in.handle.p_MH = 0.03 * normal_vector(random, 1.0).normalized();
  in.handle.q_MH = exp_rotation(0.3 * normal_vector(random, 1.0).normalized());
  for (int i = 0; i < 3; ++i) mapping.step(in, kTick_s);
  Goal before = mapping.goal();
  const Vector3 rate_m = rate_law(in.handle.p_MH, config.dead_zone_m, config.radius_max_m, config.rate_law);
  const Vector3 rate_rad =
      rate_law(log_rotation(in.handle.q_MH), config.dead_zone_rad, config.radius_max_rad, config.rate_law);
  double kv = config.kv_per_s, kv_rotation = config.kv_rotation_per_s;
  double speed = kv * rate_m.norm(), speed_rad = kv_rotation * rate_rad.norm();
  KvStep most;
  for (int i = 0; i < 2000; ++i) {
    if (random.chance(0.02)) {
      config.kv_per_s = std::exp(random.uniform(-2.0, 2.0));
      config.kv_rotation_per_s = std::exp(random.uniform(-2.0, 1.0));
      mapping.configure(config);
      if (at_once) {
        mapping = Mapping(config);
        before = mapping.step({.mode = MotionMode::kRate}, kTick_s);
      }
    }
    const Goal& after = mapping.step(in, kTick_s);
    const double now = (after.position_m - before.position_m).norm() / kTick_s;
    const double now_rad = angle_between(after.rotation, before.rotation) / kTick_s;
    most.translation = std::max(most.translation, std::abs(now - speed) / (std::exp(2.0) * rate_m.norm()));
    most.rotation =
        std::max(most.rotation, std::abs(now_rad - speed_rad) / (std::exp(1.0) * rate_rad.norm()));
    before = after;
    speed = now;
    speed_rad = now_rad;
  }
  return most;
}

TEST(MappingProperty, KvRampsTheSpeedOfTheGoal) {
  constexpr double kShare = 0.0105;  // of a time constant of 0.1 s in a tick
  const int seeds = campaign(500, 30);
  for (int seed = 1; seed <= seeds; ++seed) {
    const KvStep step = change_kv(static_cast<std::uint64_t>(seed), false);
    ASSERT_LE(step.translation, kShare) << "seed " << seed;
    ASSERT_LE(step.rotation, kShare) << "seed " << seed;
  }
  EXPECT_GT(change_kv(1, true).translation, 0.1)
      << "the control: kv is changed by a new mapping, without a ramp";
}

TEST(MappingProperty, HandleMovesNothingBeforeItWasHome) {
  const int seeds = campaign(500, 30);
  int waits = 0, leaves = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MappingConfig config = any_mapping(random);
    config.rate_centre = RateCentre::kHandleOrigin;
    Mapping mapping(config);
    MappingInput in;
    mapping.reset(in.handle);
    bool home = true, turned_home = true;  // in this stretch of rate mode
    for (int i = 0; i < 3000; ++i) {
      wander(in.handle, random, 0.1, 1.0);
      const bool began = random.chance(0.005);
      if (began) in.mode = in.mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
      const bool at_home = in.handle.p_MH.norm() <= config.dead_zone_m;
      const bool at_turn = log_rotation(in.handle.q_MH).norm() <= config.dead_zone_rad;
      home = at_home || (home && !began);
      turned_home = at_turn || (turned_home && !began);
      const Goal before = mapping.goal();
      const Goal& after = mapping.step(in, kTick_s);
      if (in.mode == MotionMode::kPosition) continue;
      ASSERT_EQ(mapping.bring_home(), !home) << "seed " << seed << " tick " << i;
      ASSERT_EQ(mapping.turn_home(), !turned_home) << "seed " << seed << " tick " << i;
      if (!home) {
        ASSERT_EQ(after.position_m, before.position_m) << "seed " << seed << " tick " << i;
      }
      if (!turned_home) {
        ASSERT_EQ(after.rotation.coeffs(), before.rotation.coeffs()) << "seed " << seed << " tick " << i;
      }
      waits += !home;
      leaves += home && after.position_m != before.position_m;
    }
  }
  EXPECT_GT(waits, 100);
  EXPECT_GT(leaves, 100);
}

/// A master whose slave has confirmed the engagement, with everything that a hand can do.
struct Master {
  explicit Master(const MasterConfig& config) : node(config) {
    in.requests.engage = true;
    tick();
    report.message = {.engagement = node.view().engagement, .state = SafetyState::kEngaged};
    report.sequence = 1;
    in.reports = {&report, 1};
    tick();
  }
  MasterOutput tick() {
    in.now += from_seconds(kTick_s);
    in.last_heard = in.now;
    const MasterOutput out = node.step(in);
    in.requests = {};
    in.reports = {};
    return out;
  }
  MasterNode node;
  MasterInput in{};
  Received<StiffnessReport> report{};
};

/// Presses or releases one thing: mode, scale, kv, clutch, the handle itself.
int act_erratically(HandleState& h, Random& random) {
  const std::array<bool*, 7> things = {
      &h.buttons.mode, &h.buttons.scale_up, &h.buttons.scale_down, &h.buttons.clutch,
      &h.held,         &h.buttons.kv_up,    &h.buttons.kv_down};
  const int which = static_cast<int>(random.uniform(0.0, 7.0));
  *things[static_cast<std::size_t>(which)] ^= true;
  return which;
}

/// What a slave would hold as goals, by the datagrams alone.
struct Asked {
  std::array<Vector3, 2> goal{Vector3::Zero(), Vector3::Zero()};
  std::array<double, 2> at_s{0.0, 0.0};

  /// Length of the step that the datagram makes, over the time since the last one of its kind.
  double speed(const MotionCommand& c, double now_s) {
    const auto k = static_cast<std::size_t>(c.goal_kind);
    const bool turns = c.goal_kind == GoalKind::kGoalOrientation;
    const double step = turns ? angle_between(exp_rotation(c.rotation_rad), exp_rotation(goal[k]))
                              : (c.position_m - goal[k]).norm();
    goal[k] = turns ? c.rotation_rad : c.position_m;
    const double elapsed_s = now_s - at_s[k];
    at_s[k] = now_s;
    return step / elapsed_s;
  }
};

TEST(MappingProperty, GoalsStaySmoothForAnyButtonInput) {
  const int seeds = campaign(500, 20);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MasterConfig config;
    config.mapping = any_mapping(random);
    Master master(config);
    Asked asked;
    for (int i = 1; i <= 3000; ++i) {
      wander(master.in.handle, random, 0.1, 1.0);
      const MasterView before = master.node.view();
      const int touched = random.chance(0.02) ? act_erratically(master.in.handle, random) : -1;
      const MasterOutput out = master.tick();
      const MasterView& after = master.node.view();
      const bool rescales = after.scale != before.scale && after.mode == MotionMode::kPosition;
      if (after.mode != before.mode || rescales || touched == 3 || touched == 4) {
        ASSERT_LE((after.goal_m - before.goal_m).norm(), kNothing) << "seed " << seed << " tick " << i;
        ASSERT_LE(angle_between(exp_rotation(after.goal_rad), exp_rotation(before.goal_rad)), 1e-9)
            << "seed " << seed << " tick " << i;
      }
      if (!out.command) continue;
      const double limit = out.command->goal_kind == GoalKind::kGoalPosition
                               ? config.mapping.speed_max_m_per_s
                               : config.mapping.speed_max_rad_per_s;
      ASSERT_LE(asked.speed(*out.command, kTick_s * i), limit * (1.0 + 1e-9) + 1e-7)
          << "seed " << seed << " tick " << i;
    }
    ASSERT_TRUE(master.node.engaged());
  }
}

}  // namespace
}  // namespace longreach::mapping_bumpless_test
