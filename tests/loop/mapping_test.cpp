// The mapping in the whole loop: what the experiments about it measure.

#include <gtest/gtest.h>

#include <map>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach::mapping_test {
namespace {

using Values = std::map<std::string, double>;

Values run(std::vector<Metric> (*experiment)(const ExperimentRun&),
           const std::vector<std::string>& settings) {
  ExperimentRun run;
  run.config = configure(settings, LONGREACH_DEPLOY);
  Values values;
  for (const Metric& m : experiment(run)) values[m.name] = m.value;
  return values;
}

TEST(RateMapping, BothLawsAreWhatTheySayAndTheRobotGetsThere) {
  const MappingConfig config;
  for (const char* profile : {"profile=lab", "profile=moon"}) {
    Values v = run(run_rate_mapping, {profile});
    for (const std::string law : {"continuous", "literal"}) {
      EXPECT_EQ(v["speed_in_dead_zone_translation_" + law], 0.0);
      EXPECT_EQ(v["speed_in_dead_zone_rotation_" + law], 0.0);
      EXPECT_LT(v["tool_behind_goal_translation_" + law], 1e-6);
      EXPECT_LT(v["tool_behind_goal_rotation_" + law], 1e-6);
    }
    // Of the handle, one count of an encoder; the centre is where the handle was, so twice.
    EXPECT_LT(v["law_error_translation_continuous"], config.kv_per_s * 5e-5);
    EXPECT_LT(v["law_error_rotation_continuous"], config.kv_rotation_per_s * 5e-4);
    EXPECT_LT(v["speed_step_translation_continuous"], config.kv_per_s * 1e-4);
    EXPECT_LT(v["speed_step_rotation_continuous"], config.kv_rotation_per_s * 1e-3);
    EXPECT_NEAR(v["speed_step_translation_literal"], config.kv_per_s * config.dead_zone_m, 2e-4);
    EXPECT_NEAR(v["speed_step_rotation_literal"], config.kv_rotation_per_s * config.dead_zone_rad, 5e-4);
  }
}

TEST(ScaleSteps, StepNeitherGoalNorForce) {
  Values v = run(run_scale_steps, {"profile=lab"});
  EXPECT_EQ(v["scale_steps"], 30.0);
  EXPECT_LE(v["goal_step_max_m"], 1e-12);
  EXPECT_LE(v["force_step_max_n"], 0.1);
  EXPECT_LE(v["friction_error_max"], 0.02);
  EXPECT_LE(v["energy_drawdown_j"], 1e-3);
}

}  // namespace
}  // namespace longreach::mapping_test
