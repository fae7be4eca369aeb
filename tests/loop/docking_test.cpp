// The task of scene `dock` from beginning to end, and a mistake.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/docking_task.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::docking_test {
namespace {

DockingOutcome docked(std::uint64_t seed, DockingMistake mistake) {
  return dock(configure({}, LONGREACH_DEPLOY), seed, mistake, nullptr);
}

/// All are safe. An operator who feels less than 3 N when the catch yields would not notice it.
TEST(Docking, SucceedsAcrossTheLinkAndIsFelt) {
  const int count = campaign(30, 1);
  int docked_and_felt = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const DockingOutcome o = docked(static_cast<std::uint64_t>(seed), DockingMistake::kNone);
    docked_and_felt += o.docked && o.felt_success;
    EXPECT_TRUE(o.grasped && o.safe) << "seed " << seed << ": " << o.pressed_max_n << " N";
    EXPECT_GT(o.felt_success_n, 1.0) << "seed " << seed;
    EXPECT_LT(o.energy_created_j, 1e-9) << "seed " << seed;
    EXPECT_GT(o.port_energy_min_j, -returned_most_j()) << "seed " << seed;
  }
  EXPECT_GE(10 * docked_and_felt, 9 * count);
}

TEST(Docking, AMistakeIsFeltAndHarmsNobody) {
  for (int m = 1; m < kDockingMistakes; ++m) {
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(campaign(10, 1)); ++seed) {
      const DockingOutcome o = docked(seed, static_cast<DockingMistake>(m));
      const std::string which =
          std::string(to_string(static_cast<DockingMistake>(m))) + ", seed " + std::to_string(seed);
      EXPECT_GT(o.felt_mistake_n, 0.5) << which;
      EXPECT_TRUE(o.ended && o.safe) << which << ": " << o.pressed_max_n << " N";
    }
  }
}

/// The largest pressing force in the report is that of a mistake: without mistakes, it is much smaller.
TEST(Docking, TheLargestForceIncludesTheMistakes) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  double largest_n = 0.0, of_mistakes_n = 0.0, of_good_n = 0.0;
  for (const Metric& m : run_docking(run)) {
    if (m.name == "pressed_max_n")
      largest_n = m.value;
    else if (m.name == "docked_pressed_max_n")
      of_good_n = m.value;
    else if (m.name.ends_with("_pressed_max_n"))
      of_mistakes_n = std::max(of_mistakes_n, m.value);
  }
  EXPECT_GT(of_mistakes_n, of_good_n) << "the control: without the mistakes the figure would be another";
  EXPECT_EQ(largest_n, std::max(of_mistakes_n, of_good_n));
}

}  // namespace
}  // namespace longreach::docking_test
