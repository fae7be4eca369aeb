// What people do, over five links, with light and firm hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/config/config.hpp"
#include "master/rendering/rendering_config.hpp"
#include "tests/experiments/experiment.hpp"
#include "tests/experiments/laboratory.hpp"

namespace longreach {
namespace {

TEST(Person, FindsWhatSceneTruthSaysInEveryRowAndTheControlFails) {
  ExperimentRun run;
  run.config = configure({}, LONGREACH_DEPLOY);
  std::map<std::string, double> m;
  for (const Metric& metric : find_experiment("person")->run(run)) m[metric.name] = metric.value;
  EXPECT_GE(m.at("trials"), 430.0);
  for (const auto& [name, value] : m) {
    if (name.starts_with("failed")) {
      EXPECT_EQ(value, 0.0) << name;
    }
  }
  EXPECT_GE(m.at("controls"), 50.0);
  EXPECT_GE(m.at("controls_failed"), 0.9 * m.at("controls"));
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

}  // namespace
}  // namespace longreach
