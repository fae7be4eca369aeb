// What people do, over five links, with light and firm hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "common/recording/build_name.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::person_test {
namespace {

/// Seeds: one that never changes, another one, and one that each commit draws.
std::array<std::uint64_t, 3> seeds() { return {1, 2, std::hash<std::string>{}(build_name()) % 1000000}; }

// At full size all links and grips.
TEST(Person, FindsWhatSceneTruthSaysInEveryRowAndTheControlFails) {
  double trials = 0.0, controls = 0.0, controls_failed = 0.0;
  for (const std::uint64_t seed : seeds()) {
    ExperimentRun run;
    run.config = configure({}, LONGREACH_DEPLOY);
    run.seed = seed;
    run.sample = campaign(0, 1) == 1;
    run.check = [&](const TrialCheck& c) {
      EXPECT_LE(c.value, c.most) << c.trial << ": " << c.what << ", seed " << seed;
    };
    std::map<std::string, double> m;
    for (const Metric& metric : find_experiment("person")->run(run)) m[metric.name] = metric.value;
    EXPECT_EQ(m.at("failed"), 0.0);
    trials += m.at("trials");
    controls += m.at("controls");
    controls_failed += m.at("controls_failed");
  }
  EXPECT_GE(trials, 3.0 * 50.0);
  EXPECT_GE(controls, 3.0 * 5.0);
  EXPECT_GE(controls_failed, 0.9 * controls);
}

// Rows that failed with a seed once.
TEST(Person, FindsWhatSceneTruthSaysWithSeedsThatFailedOnce) {
  const struct {
    const char* only;
    std::uint64_t seed;
  } kOnce[] = {
      {"touch-lightly,lab,firm", 75},      {"touch-briefly,kontur,firm", 201},
      {"touch-lightly,kontur,firm", 205},  {"touch-briefly,kontur,firm", 205},
      {"blackout,etsvii,firm", 74},        {"blackout,etsvii,firm", 209},
      {"touch-lightly,gateway,firm", 207}, {"touch-lightly,kontur,light", 324},
      {"two-faces,kontur,firm", 208},      {"two-faces,kontur,light", 217},
  };
  for (const auto& [only, seed] : kOnce) {
    ExperimentRun run;
    run.config = configure({}, LONGREACH_DEPLOY);
    run.seed = seed;
    run.only = only;
    int checks = 0;
    run.check = [&](const TrialCheck& c) {
      ++checks;
      EXPECT_LE(c.value, c.most) << c.trial << ": " << c.what << ", seed " << seed;
    };
    (void)find_experiment("person")->run(run);
    EXPECT_GT(checks, 0) << only;
  }
}

/// What a light hand gets out of a thousand loads and unloads in ten minutes, by true motion, J; the wall is
/// as stiff as the device can render.
double returned_j(RenderingLaw law) {
  const proto::LabConfig config =
      configure({"profile=moon", "safety.engage_at_start=true", "scene.material.wall.stiffness_n_per_m=7000",
                 "scene.surface.wall.plane.point_m=0.03,0,0"},
                LONGREACH_DEPLOY);
  MasterConfig master = to_struct(config.master());
  master.rendering.law = law;
  Laboratory lab(master, to_struct(config.slave()), 1);
  constexpr double kLoad_s = 0.6, kLoads = 1000.0, kStart_s = 10.0;
  double energy_j = 0.0, least_j = 0.0;
  Vector3 x_m = lab.devices().delta().position_m(), force_n = Vector3::Zero();
  while (lab.now_s() < kStart_s + kLoads * kLoad_s) {
    const double phase = std::fmod(lab.now_s(), kLoad_s) / kLoad_s;
    const double deep_m = lab.now_s() < kStart_s ? 0.0 : 0.05 - (phase < 0.5 ? 0.0 : 0.004);
    HandTarget target;
    target.position_m.x() = deep_m;
    lab.drive(target);
    lab.step();
    energy_j -= force_n.dot(lab.devices().delta().position_m() - x_m);
    x_m = lab.devices().delta().position_m();
    force_n = lab.master().F_H_M.force;
    least_j = std::min(least_j, energy_j);
  }
  EXPECT_EQ(lab.master().state, SafetyState::kEngaged);
  EXPECT_TRUE(lab.master().surface_known);
  return -least_j;
}

TEST(Store, AThousandLoadsWinNothingFromIt) {
  EXPECT_LE(returned_j(RenderingLaw::kStiffness), returned_most_j());
  EXPECT_GT(returned_j(RenderingLaw::kNaive), 2.0 * returned_most_j());
}

/// A force sensor whose zero steps.
struct BiasedSensor : FaultHooks {
  void robot_reported(Time /*now*/, RobotState& reported) override { reported.F_F_W.force += bias_n; }
  Vector3 bias_n = Vector3::Zero();
};

/// Contact force at a light hand that presses, at rest or probing by 1.5 mm, every tick of the 8 s after the
/// sensor's zero has stepped.
std::vector<double> felt_n(const Vector3& bias_n, double probe_m) {
  const proto::LabConfig config =
      configure({"profile=lab", "safety.engage_at_start=true", "scene.surface.wall.plane.point_m=0.02,0,0"},
                LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  BiasedSensor sensor;
  lab.set_fault_hooks(sensor);
  constexpr double kTouch_s = 3.0, kStep_s = 12.0, kEnd_s = 20.0;
  std::vector<double> felt;
  while (lab.now_s() < kEnd_s) {
    const double way_m = 0.042 * std::min(1.0, lab.now_s() / kTouch_s);
    HandTarget target;
    target.position_m.x() = way_m + probe_m * std::sin(2.0 * std::numbers::pi * 0.5 * lab.now_s());
    lab.drive(target);
    if (lab.now_s() >= kStep_s) sensor.bias_n = bias_n;
    lab.step();
    if (lab.now_s() >= kStep_s) felt.push_back(lab.master().spring_force_n.norm());
  }
  return felt;
}

TEST(Person, AStepOfTheSensorsZeroIsNotFelt) {
  for (const double probe_m : {0.0, 1.5e-3}) {
    const std::vector<double> without = felt_n(Vector3::Zero(), probe_m);
    EXPECT_GT(*std::ranges::min_element(without), 1.0);
    for (int axis = 0; axis < 6; ++axis) {
      const std::vector<double> with = felt_n((axis < 3 ? 1.0 : -1.0) * Vector3::Unit(axis % 3), probe_m);
      ASSERT_EQ(with.size(), without.size());
      double most_n = 0.0;
      for (std::size_t i = 0; i < with.size(); ++i) most_n = std::max(most_n, std::abs(with[i] - without[i]));
      EXPECT_LT(most_n, 0.1) << "axis " << axis << " probing by " << probe_m;
    }
  }
}

}  // namespace
}  // namespace longreach::person_test
