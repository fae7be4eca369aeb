// The material changes under the tool, as the experiment has it: what was told of the one before must not
// stay.

#include <gtest/gtest.h>

#include <map>

#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::material_steps_test {
namespace {

// The slowest is a soft tile behind a hard one: nothing is pressed until the tool has followed.
TEST(MaterialSteps, ReportFollowsMaterialWithoutForceStep) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> all;
  for (const Metric& m : run_material_steps(run)) all[m.name] = m.value;
  ASSERT_EQ(all.size(), 3u * 2u * 8u);
  for (const std::string name : {"layers", "soft_to_hard", "hard_to_soft"}) {
    for (const std::string kind : {"fixed_exponent", "maximum_likelihood"}) {
      const std::string of = name + "_" + kind;
      EXPECT_GE(all[of + "_changes"], 2.0) << of;
      // A force falls at once where the news is that its material is gone: nothing else may step.
      EXPECT_LE(all[of + "_force_rise_excess_n"], 0.0) << of;
      EXPECT_GE(all[of + "_port_energy_min_j"], -returned_most_j()) << of;
      EXPECT_EQ(all[of + "_followed"], all[of + "_changes"]) << of;
      EXPECT_LE(all[of + "_slowest_s"], 6.0) << of;
      EXPECT_LE(all[of + "_farthest_m"], 0.015) << of;
      EXPECT_LE(all[of + "_error_end"], 0.2) << of;
    }
  }
}

}  // namespace
}  // namespace longreach::material_steps_test
