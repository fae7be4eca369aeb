// Unknown force sensors move freely and meet walls, with default settings.

#include <gtest/gtest.h>

#include <map>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"

namespace longreach::free_motion_test {
namespace {

TEST(FreeMotion, MakesNoContactAndHidesNone) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> all;
  for (const Metric& m : run_free_motion_study(run)) all[m.name] = m.value;
  EXPECT_GT(all.at("moved_s"), 0.9 * 60.0 * all.at("sensors"));
  EXPECT_EQ(all.at("false_contacts"), 0.0);
  EXPECT_EQ(all.at("walls_found"), all.at("walls"));
  EXPECT_EQ(all.at("slow_walls_found"), all.at("slow_walls"));
  // The control: a threshold from a file, in noise and drift that it does not fit.
  EXPECT_GT(all.at("fixed_false_contacts"), 0.0);
}

}  // namespace
}  // namespace longreach::free_motion_test
