// Nobody described the material, and the settings are the defaults.

#include <gtest/gtest.h>

#include <map>

#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::unknown_contact_test {
namespace {

TEST(UnknownContact, IsFeltAsItIsWithDefaultSettingsAndTheControlsAreNot) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> all;
  for (const Metric& m : run_unknown_contact(run)) all[m.name] = m.value;
  const double cells = all.at("cells"), controls = all.at("control_cells");
  EXPECT_GE(all["right"], 0.98 * cells);
  EXPECT_LE(all["returned_max_j"], returned_most_j());
  EXPECT_EQ(all["limit_cycles"], 0.0);
  EXPECT_GE(all["covered"], 0.97 * cells);
  EXPECT_LE(all["sd_over_bound_median"], 2.0);
  EXPECT_LE(all["first_over_bound_max"], 1.2);
  EXPECT_LE(all["first_over_fixed_median"], 1.6);
  EXPECT_LE(all["family_without_law"], 0.01 * cells);
  EXPECT_GE(all["outside_tangent_within_15_percent"], 0.9 * all.at("outside_cells"));
  EXPECT_EQ(all["light_one_contact_a_press"], all.at("light_cells"));
  EXPECT_GE(all["untold_noise_covered"], 0.97 * controls - 1.0);
  EXPECT_LT(all["control_assumed_exponent_right"], 0.9 * controls);
  EXPECT_LT(all["control_usual_force_right"], 0.9 * controls);
  EXPECT_LT(all["control_a_third_of_sd_covered"], 0.9 * cells);
}

}  // namespace
}  // namespace longreach::unknown_contact_test
