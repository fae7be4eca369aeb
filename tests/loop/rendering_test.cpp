// What the hand feels under hostile news, at a first touch, in a spike of the delay, in rate mode and in six
// degrees of freedom.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::rendering_test {
namespace {

std::map<std::string, double> metrics(std::string_view name, const std::vector<std::string>& settings = {},
                                      std::uint64_t seed = 1) {
  ExperimentRun run;
  run.seed = seed;
  run.config = configure(settings, LONGREACH_DEPLOY);
  std::map<std::string, double> values;
  for (const Metric& m : find_experiment(name)->run(run)) values[m.name] = m.value;
  return values;
}

TEST(HostileUpdates, GiveNoEnergyAndTheNaiveLawFailsUnderTheSame) {
  auto m = metrics("hostile-updates");
  // Counted where they arrive: half of what is sent is lost, and what was overtaken is not taken.
  EXPECT_NEAR(m.at("updates"), 0.5e6, 5e3);
  EXPECT_GT(m.at("reports_applied"), 1e5);
  EXPECT_LE(m.at("reports_applied") + m.at("reports_refused"), m.at("updates"));
  EXPECT_GE(m.at("port_energy_min_j"), -returned_most_j());
  EXPECT_LE(m.at("energy_drawdown_j"), 1e-3);
  // They may take the force away at once, and make it rise by less than the slew of a tick.
  EXPECT_LE(m.at("force_step_excess_n"), 20.0);
  EXPECT_LE(m.at("force_rise_excess_n"), 5.0);
  EXPECT_EQ(m.at("unsafe_wrenches"), 0.0);
  EXPECT_LT(m.at("naive_port_energy_min_j"), -1.0);
  EXPECT_GT(m.at("naive_force_step_excess_n"), 10.0);
  EXPECT_EQ(m.at("naive_unsafe_wrenches"), 0.0);
}

TEST(Idle, IdleHandIsQuietAndEncoderStepDampingIsNot) {
  auto m = metrics("idle");
  EXPECT_EQ(m.at("not_engaged"), 0.0);
  EXPECT_EQ(m.at("not_touched"), 0.0);
  EXPECT_GE(m.at("pressed_at_cap"), 5.0);
  EXPECT_LE(m.at("energy_out_max_j"), 1e-4);
  EXPECT_LE(m.at("rotation_energy_out_max_j"), 1e-4);
  EXPECT_LE(m.at("ripple_beyond_a_count_max_n"), 0.02);
  EXPECT_LE(m.at("ripple_beyond_a_count_max_nm"), 4e-4);
  EXPECT_GE(m.at("quiet_share"), 0.8);
  EXPECT_EQ(m.at("limit_cycles"), 0.0);
  EXPECT_EQ(m.at("bad"), 0.0);
  EXPECT_GE(m.at("control_bad"), 0.4 * m.at("control_draws"));
  EXPECT_GT(m.at("control_energy_out_max_j"), 1e-4);
}

TEST(FirstTouch, GrowsSmoothlyAndRegistersWallByTouchSequence) {
  auto m = metrics("first-touch");
  EXPECT_LE(m.at("felt_after_round_trip_s"), 0.2);
  EXPECT_GT(m.at("felt_after_round_trip_s"), 0.0);
  EXPECT_LE(m.at("force_step_max_n"), 0.1);
  EXPECT_LE(m.at("registration_error_m"), 1e-3);
  EXPECT_GT(m.at("registration_error_without_touch_sequence_m"), 10.0 * 1e-3);
  EXPECT_GE(m.at("port_energy_min_j"), -returned_most_j());
}

TEST(FirstTouch, IsHeldByTheForceGuardAndByNothingElse) {
  auto m = metrics("first-touch");
  EXPECT_LE(m.at("guard_peak_over_guard_max"), 1.35);
  EXPECT_GT(m.at("guard_peak_over_guard_max_without_guard"), 10.0);
  EXPECT_NEAR(m.at("hold_force_over_guard"), 0.5, 0.025);
}

TEST(Spike, EasesTheForceAndLetsTheWorkGoOnAfterANewEngagement) {
  auto m = metrics("spike");
  EXPECT_GT(m.at("force_when_it_began_n"), 1.0);
  EXPECT_NEAR(m.at("stiffness_left_after_time_constant"), std::exp(-1.0), 0.01);
  EXPECT_LE(m.at("force_rise_max_n"), 0.1);
  EXPECT_LT(m.at("force_two_seconds_later_n"), 0.01);
  EXPECT_EQ(m.at("engagements"), 2.0);
  EXPECT_EQ(m.at("pressed_again"), 1.0);
  EXPECT_GE(m.at("port_energy_min_j"), -returned_most_j());
  EXPECT_LE(m.at("energy_drawdown_j"), 1e-3);
}

TEST(RateContact, IsProportionalToTheForceOfTheSlaveWhileTheHandIsStill) {
  auto m = metrics("rate-contact");
  EXPECT_LE(m.at("ratio_spread"), 1.35);
  EXPECT_NEAR(m.at("ratio_max"), RenderingConfig{}.rate_force_ratio, 0.02);
  EXPECT_GT(m.at("control_spread"), 3.0);
  EXPECT_LE(m.at("force_rise_max_n"), 0.1);
  EXPECT_EQ(m.at("left"), 1.0);
  EXPECT_GE(m.at("port_energy_min_j"), -returned_most_j());
}

class SixDofContact : public testing::TestWithParam<std::uint64_t> {};

// In a corner, each surface is known by what the others leave.
TEST_P(SixDofContact, IsFeltThroughTheWholeLoop) {
  auto m = metrics("six-dof-contact", {}, GetParam());
  EXPECT_LE(m.at("oblique_displayed_error"), 0.05);
  EXPECT_LE(m.at("oblique_force_error"), 0.05);
  EXPECT_LE(m.at("oblique_tangential_n"), 0.1);
  EXPECT_LE(m.at("torque_displayed_error"), 0.05);
  for (const char* corner : {"corner_60", "corner_90", "corner_120", "three_walls", "diagonal"}) {
    EXPECT_LE(m.at(std::string(corner) + "_force_error"), 0.1) << corner;
    EXPECT_LE(m.at(std::string(corner) + "_slope_error"), 0.1) << corner;
  }
  for (const char* scene : {"oblique", "corner_60", "three_walls", "diagonal", "torque"})
    EXPECT_GE(m.at(std::string(scene) + "_port_energy_min_j"), -returned_most_j()) << scene;
}

// With seeds 7, 16 and 72, earlier versions were wrong by 60 to 200 %.
INSTANTIATE_TEST_SUITE_P(Seeds, SixDofContact, testing::Values(1, 7, 16, 72));

TEST(SixDofContactControl, AWrongExponentIsFelt) {
  auto wrong = metrics("six-dof-contact", {"estimator.kind=FIXED_EXPONENT", "estimator.exponent=3"});
  EXPECT_GT(wrong.at("oblique_force_error"), 0.05);
}

TEST(TensorRendering, DisplaysAnObliquePlaneACornerAndATorque) {
  auto m = metrics("tensor-rendering");
  EXPECT_LE(m.at("oblique_displayed_error"), 0.05);
  EXPECT_LE(m.at("oblique_tangential_n"), 0.01);
  EXPECT_LE(m.at("oblique_registration_error_m"), 1e-3);
  EXPECT_LE(m.at("corner_displayed_error_x"), 0.05);
  EXPECT_LE(m.at("corner_displayed_error_y"), 0.05);
  EXPECT_LE(m.at("torque_displayed_error"), 0.05);
  for (const char* scene : {"oblique", "corner", "torque"})
    EXPECT_GE(m.at(std::string(scene) + "_port_energy_min_j"), -returned_most_j()) << scene;
}

TEST(HapticReturn, SteadyContactNeedsTenDatagramsPerSecond) {
  for (const char* profile : {"lab", "moon"}) {
    auto m = metrics("touch", {std::string("profile=") + profile});
    EXPECT_LE(m.at("haptic_return_datagrams_per_s"), 10.1) << profile;
    EXPECT_GE(m.at("haptic_return_datagrams_per_s"), 3.0) << profile;
    EXPECT_LE(m.at("haptic_return_bit_per_s"), 4000.0) << profile;
    EXPECT_LE(m.at("displayed_stiffness_error"), 0.05) << profile;
  }
}

}  // namespace
}  // namespace longreach::rendering_test
