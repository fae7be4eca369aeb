#include "master/mapping/gain_steps.hpp"

#include <gtest/gtest.h>

#include "master/master_node.hpp"

namespace longreach::gain_steps_test {
namespace {

/// A master that is engaged in rate mode.
struct EngagedMaster {
  explicit EngagedMaster(const MasterConfig& config) : node(config) {
    in.requests.engage = true;
    tick();
    report.message = {.engagement = node.view().engagement, .state = SafetyState::kEngaged};
    report.sequence = 1;
    in.reports = {&report, 1};
    in.requests.mode = MotionMode::kRate;
    tick();
    tick();
    EXPECT_TRUE(node.engaged());
  }
  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      in.now += std::chrono::milliseconds(1);
      in.last_heard = in.now;
      node.step(in);
      in.requests = {};
      in.reports = {};
    }
  }
  void change_kv(int steps) {
    in.requests.kv_steps = steps;
    tick();
  }
  MasterNode node;
  MasterInput in{};
  Received<StiffnessReport> report{};
};

TEST(GainSteps, StepsEndAtTheEndsOfTheRange) {
  EXPECT_DOUBLE_EQ(stepped_kv(2.0, 1), 2.5);
  EXPECT_DOUBLE_EQ(stepped_kv(stepped_kv(2.0, 3), -3), 2.0);
  EXPECT_EQ(stepped_kv(2.0, 2147483647), kKvMax_per_s);
  EXPECT_EQ(stepped_kv(2.0, -2147483647), kKvMin_per_s);
  EXPECT_EQ(stepped_kv(3.7, 0), 3.7);
  EXPECT_NEAR(stepped_scale(0.83, 1), 0.9, 1e-12);
  EXPECT_EQ(stepped_scale(0.83, 0), 0.83);
}

TEST(GainSteps, KeysChangeBothKvWhileEngaged) {
  EngagedMaster m({});
  m.change_kv(2);
  EXPECT_NEAR(m.node.view().kv_per_s, 2.0 * 1.25 * 1.25, 1e-12);
  EXPECT_NEAR(m.node.view().kv_rotation_per_s, 0.5 * 1.25 * 1.25, 1e-12);
  m.in.requests.kv_per_s = 4.0;
  m.tick();
  EXPECT_NEAR(m.node.view().kv_per_s, 4.0, 1e-12);
  EXPECT_NEAR(m.node.view().kv_rotation_per_s, 1.0, 1e-12);
  m.in.requests.kv_per_s = 0.0;
  m.tick();
  EXPECT_EQ(m.node.view().rejected_values, 1U);
  EXPECT_NEAR(m.node.view().kv_per_s, 4.0, 1e-12);
}

TEST(GainSteps, ButtonsOfTheDeviceChangeBothKvWhileEngaged) {
  EngagedMaster m({});
  m.tick(20);
  m.in.handle.buttons = {.kv_up = true};
  m.tick(50);  // held: once
  EXPECT_NEAR(m.node.view().kv_per_s, 2.5, 1e-12);
  EXPECT_NEAR(m.node.view().kv_rotation_per_s, 0.625, 1e-12);
  m.in.handle.buttons = {};
  m.tick(20);
  m.in.handle.buttons = {.kv_down = true};
  m.tick();
  EXPECT_NEAR(m.node.view().kv_per_s, 2.0, 1e-12);
  m.in.handle.buttons = {};
  m.tick(20);
  m.in.handle.buttons = {.kv_up = true, .kv_down = true};
  m.tick();
  EXPECT_NEAR(m.node.view().kv_per_s, 2.0, 1e-12) << "both at once";
  m.in.handle.ok = false;
  m.tick();
  m.in.handle.ok = true;
  m.tick(50);
  EXPECT_NEAR(m.node.view().kv_per_s, 2.0, 1e-12) << "held when the device appears";
  EXPECT_EQ(m.node.view().mode, MotionMode::kRate);
}

TEST(GainSteps, KvMovesTheGoalFasterOnceItHasRamped) {
  EngagedMaster m({});
  while (m.in.handle.p_MH.x() < 0.015) m.in.handle.p_MH.x() += 1e-4, m.tick();
  const auto speed_m_per_s = [&m] {
    const double before_m = m.node.view().goal_m.x();
    m.tick();
    return (m.node.view().goal_m.x() - before_m) / 0.001;
  };
  const double before = speed_m_per_s();
  m.change_kv(2);
  EXPECT_NEAR(speed_m_per_s(), before, 0.03 * before) << "no step";
  m.tick(1500);
  EXPECT_NEAR(speed_m_per_s(), 1.5625 * before, 1e-6);
}

// A change of another field keeps what the keys have set; a change of kv itself takes effect.
TEST(GainSteps, ConfigurationKeepsWhatKeysHaveSet) {
  MasterConfig config;
  EngagedMaster m(config);
  m.change_kv(1);
  config.rendering.ke = 0.5;
  m.node.configure(config);
  EXPECT_NEAR(m.node.view().kv_per_s, 2.5, 1e-12);
  config.mapping.kv_per_s = 1.0;
  m.node.configure(config);
  EXPECT_EQ(m.node.view().kv_per_s, 1.0);
  EXPECT_NEAR(m.node.view().kv_rotation_per_s, 0.625, 1e-12);
}

}  // namespace
}  // namespace longreach::gain_steps_test
