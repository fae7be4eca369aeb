// Free bodies, a gripper and a latch in MuJoCo: the experiments drag and docking with another simulator.

#include <gtest/gtest.h>

#include <string>

#include "common/config/config.hpp"
#include "deploy/lab/contact/docking_task.hpp"
#include "deploy/lab/contact/drag.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mjcf_robots.hpp"

namespace longreach::mujoco_bodies_loop_test {
namespace {

class MujocoBodiesLoop : public testing::Test {
 protected:
  void SetUp() override {
    use_mujoco();
    run_.config = configure({"robot.mjcf=" + std::string(LONGREACH_DEPLOY) + "/mujoco/scenes/space_arm.xml",
                             "robot_file=robots/space_arm.txtpb"},
                            LONGREACH_DEPLOY);
    run_.seed = 1;
  }
  void TearDown() override { mjcf_robots = nullptr; }
  ExperimentRun run_;
};

TEST_F(MujocoBodiesLoop, ALoadIsHeldAndItsMassIsFound) {
  const DragCell cell{.mass_kg = 8.0, .speed_m_per_s = 0.03, .noise_n = 0.02};
  const DragResult result = run_drag(run_, cell);
  EXPECT_TRUE(result.held && result.moved);
  EXPECT_EQ(result.phantoms, 0);
  EXPECT_EQ(result.holds, 0);
  EXPECT_NEAR(result.reported_kg, 8.0, 0.05 * 8.0);
  EXPECT_LE(result.overrun_m, 1e-3);
  const DragResult again = run_drag(run_, cell);
  EXPECT_EQ(result.reported_kg, again.reported_kg);
  EXPECT_EQ(result.push_n, again.push_n);
}

TEST_F(MujocoBodiesLoop, AWallIsFoundByTheLoad) {
  const DragResult result = run_drag(run_, {.mass_kg = 5.0, .speed_m_per_s = 0.01, .wall = true});
  EXPECT_TRUE(result.held && result.moved);
  EXPECT_EQ(result.phantoms, 0);
  EXPECT_GT(result.found_s, 0.0);
  EXPECT_LE(result.found_s, 0.05);
}

TEST_F(MujocoBodiesLoop, ASpacecraftIsDockedAndTheLatchIsFelt) {
  const DockingOutcome outcome = dock(run_.config, 1, DockingMistake::kNone, nullptr);
  EXPECT_TRUE(outcome.grasped && outcome.docked && outcome.felt_success && outcome.safe);
  EXPECT_GT(outcome.felt_success_n, 5.0);
  EXPECT_LT(outcome.pressed_max_n, 1.35 * 20.0);
}

}  // namespace
}  // namespace longreach::mujoco_bodies_loop_test
