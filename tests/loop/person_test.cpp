// What people do, over five links, with light and firm hands.
#include <gtest/gtest.h>

#include <map>

#include "tests/experiments/experiment.hpp"

namespace longreach {
namespace {

TEST(Person, FindsWhatSceneTruthSaysInEveryRowAndTheControlFails) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> m;
  for (const Metric& metric : find_experiment("person")->run(run)) m[metric.name] = metric.value;
  EXPECT_GE(m.at("trials"), 320.0);
  for (const auto& [name, value] : m) {
    if (name.starts_with("failed")) EXPECT_EQ(value, 0.0) << name;
  }
  EXPECT_GE(m.at("controls"), 50.0);
  EXPECT_GE(m.at("controls_failed"), 0.9 * m.at("controls"));
}

}  // namespace
}  // namespace longreach
