// The scenes that ship: what their files promise, as the simulated robot meets it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "slave/simulation/simulated_arm.hpp"

namespace longreach::scene_files_test {
namespace {

struct Ready {
  explicit Ready(const std::string& name) {
    proto::SlaveConfig message;
    message.set_scene_file("scenes/" + name + ".txtpb");
    resolve_files(message, LONGREACH_DEPLOY);
    config = to_struct(message);
    start = SimulatedArm(config, Random(1)).start_pose();
    scene.emplace(config.scene, start);
  }
  [[nodiscard]] SceneContact at(const Vector3& from_start_m) const {
    return scene->contact({.p_WE = start.p + from_start_m, .q_WE = start.q});
  }
  SlaveConfig config;
  Pose start;
  std::optional<Scene> scene;
};

TEST(SceneFiles, MaterialsAreTilesFromSpongeToSteel) {
  const Ready ready("materials");
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double y = 0.04 * (column - 2), z = 0.04 * (row - 1), secant = std::pow(10.0, 2 + column);
      const double exponent = 1.0 + 0.5 * row;
      for (const double depth : {0.001, 0.002}) {
        const SceneContact c = ready.at({0.105 + depth, y, z});
        const double expected = secant * depth * std::pow(depth / 0.001, exponent - 1.0);
        EXPECT_NEAR(c.force_n.x(), -expected, 1e-9 * expected) << row << " " << column;
        EXPECT_EQ(c.contacts, 1);
      }
    }
  }
  EXPECT_EQ(ready.at({0.1, 0, 0}).contacts, 0);
}

TEST(SceneFiles, LayersStiffenWithDepth) {
  const Ready ready("layers");
  const auto tangent = [&](double depth) {
    return (ready.at({0.105 + depth, 0, 0}).force_n - ready.at({0.106 + depth, 0, 0}).force_n).x() / 0.001;
  };
  EXPECT_NEAR(tangent(0.002), 300.0, 1e-6);
  EXPECT_NEAR(tangent(0.006), 1300.0, 1e-6);
  EXPECT_NEAR(tangent(0.012), 11300.0, 1e-6);
}

// Four lines and three quarter turns, free of contact up to the target.
TEST(SceneFiles, PathLeadsToTheTarget) {
  const Ready ready("path");
  EXPECT_EQ(ready.config.robot.name, "cartesian");
  const PathConfig& path = ready.config.scene.path.value();
  ASSERT_EQ(path.waypoint.size(), 5u);
  std::vector<Vector3> way{path.waypoint.front().point_m};
  for (std::size_t i = 1; i + 1 < path.waypoint.size(); ++i) {
    const Vector3 corner = path.waypoint[i].point_m;
    const Vector3 in = (corner - path.waypoint[i - 1].point_m).normalized();
    const Vector3 out = (path.waypoint[i + 1].point_m - corner).normalized();
    EXPECT_NEAR(in.dot(out), 0.0, 1e-12);
    const double r = path.turn_radius_m;
    for (double angle = 0.0; angle <= 1.571; angle += 0.0785)
      way.push_back(corner - r * in + r * out + r * (std::sin(angle) * in - std::cos(angle) * out));
  }
  way.push_back(path.waypoint.back().point_m);
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (double share = 0.0; share < 0.99; share += 0.05)
      EXPECT_EQ(ready.at(way[i - 1] + share * (way[i] - way[i - 1])).contacts, 0) << i;
  }
  EXPECT_EQ(ready.at(way.back() + Vector3(0.001, 0, 0)).contacts, 1);
}

TEST(SceneFiles, HingeStopsATurnOnBothSides) {
  const Ready ready("hinge");
  for (const double side : {1.0, -1.0}) {
    const Quaternion q = exp_rotation(Vector3(0, 0, 0.07 * side)) * ready.start.q;
    const SceneContact c = ready.scene->contact({.p_WE = ready.start.p, .q_WE = q});
    EXPECT_NEAR(c.moment_nm.z(), -10.0 * 0.02 * side, 1e-9);
    EXPECT_EQ(c.force_n.norm(), 0.0);
  }
}

std::map<std::string, double> by_name(const std::vector<Metric>& metrics) {
  std::map<std::string, double> all;
  for (const Metric& m : metrics) all[m.name] = m.value;
  return all;
}

TEST(ScenesCost, TellsOfEachSceneAndOfTenThousandSurfaces) {
  const auto cost = by_name(run_scenes_cost({}));
  for (const char* name :
       {"free_step_us", "wall_step_us", "materials_step_us", "layers_step_us", "path_step_us",
        "hinge_step_us", "dock_step_us", "1_resting_us", "10000_resting_us", "10000_moving_us"})
    EXPECT_GT(cost.at(name), 0.0) << name;
}

TEST(ImpactExperiment, FindsTheOneIntegratorThatIsRightForAnyStiffness) {
  const auto found = by_name(run_impact({}));
  EXPECT_EQ(found.at("discrete_gradient_right"), 100.0);
  EXPECT_LE(found.at("discrete_gradient_error_max"), 1e-10);
  EXPECT_LE(found.at("discrete_gradient_rise_max"), 1e-12);
  EXPECT_LT(found.at("rk4_right"), 50.0);
}

}  // namespace
}  // namespace longreach::scene_files_test
