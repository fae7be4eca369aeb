// No change that the operator makes moves the goal: mode, scale, clutch, letting go and taking the handle
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

/// Presses or releases one thing: mode, scale up, scale down, clutch, the handle itself.
int act_erratically(HandleState& h, Random& random) {
  const std::array<bool*, 5> things = {&h.buttons.mode, &h.buttons.scale_up, &h.buttons.scale_down,
                                       &h.buttons.clutch, &h.held};
  const int which = static_cast<int>(random.uniform(0.0, 5.0));
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
      if (after.mode != before.mode || rescales || touched >= 3) {
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
