#include "slave/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/core/random.hpp"

namespace longreach {
namespace {

SceneConfig wall(double stiffness, double exponent, double damping) {
  SceneConfig scene;
  scene.material = {{"m", stiffness, 1e-3, exponent, damping}};
  scene.surface = {{"s", "m", {Vector3(0.2, 0, 0), Vector3(-2, 0, 0), true}}};
  return scene;
}

TEST(Scene, FollowsHuntAndCrossleyInClosedForm) {
  const Vector3 start(11, 0, 2);
  for (const double n : {1.0, 1.5, 3.0}) {
    const Scene scene(wall(1000.0, n, 0.5), start);
    for (const double depth : {1e-9, 1e-4, 1e-3, 2e-2}) {
      const SceneContact c = scene.contact({start + Vector3(0.2 + depth, 5, -3), Vector3(0.01, 0.3, 0)});
      const double expected = 1000.0 * 1e-3 * std::pow(depth / 1e-3, n) * (1.0 + 0.5 * 0.01);
      EXPECT_NEAR(c.force_n.x(), -expected, 1e-5 * expected) << "n " << n << " depth " << depth;
      EXPECT_EQ(c.force_n.y(), 0.0);
      EXPECT_NEAR(c.depth_m, depth, 1e-14);
      EXPECT_NEAR(scene.secant_n_per_m(0, 4e-3), 1000.0 * std::pow(4.0, n - 1.0), 1e-9);
    }
  }
}

TEST(Scene, NeverPulls) {
  const Scene scene(wall(1e6, 1.5, 100.0), Vector3::Zero());
  Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 p(random.uniform(0.1, 0.3), random.normal(), random.normal());
    const Vector3 v(random.normal(), random.normal(), random.normal());
    const SceneContact c = scene.contact({p, v});
    EXPECT_LE(c.force_n.x(), 0.0);
    if (p.x() < 0.2) {
      EXPECT_EQ(c.force_n.norm(), 0.0);
    }
  }
}

TEST(Scene, SumsItsSurfaces) {
  SceneConfig config = wall(1000.0, 1.0, 0.0);
  config.surface.push_back({"floor", "m", {Vector3(0, 0, 1), Vector3::UnitZ(), false}});
  const Scene scene(config, Vector3::Zero());
  const SceneContact c = scene.contact({Vector3(0.201, 0, 0.998), Vector3::Zero()});
  EXPECT_NEAR((c.force_n - Vector3(-1.0, 0, 2.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(c.surface, 1);
}

TEST(Scene, RefusesWhatItCannotBuild) {
  SceneConfig config = wall(1000.0, 1.0, 0.0);
  config.surface[0].material = "cheese";
  EXPECT_THROW(Scene(config, Vector3::Zero()), std::invalid_argument);
  config = wall(1000.0, 1.0, 0.0);
  config.surface[0].plane.normal.setZero();
  EXPECT_THROW(Scene(config, Vector3::Zero()), std::invalid_argument);
}

TEST(Scene, FeelsNothingWhereThereIsNoNumber) {
  const Scene scene(wall(1000.0, 1.5, 0.1), Vector3::Zero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scene.contact({Vector3(nan, 0, 0), Vector3::Zero()}).force_n, Vector3::Zero());
  EXPECT_EQ(scene.contact({Vector3(0.3, 0, 0), Vector3(nan, 0, 0)}).force_n, Vector3::Zero());
  EXPECT_EQ(Scene(SceneConfig{}, Vector3::Zero()).contact({}).surface, -1);
}

}  // namespace
}  // namespace longreach
