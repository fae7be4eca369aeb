#include "slave/simulation/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "common/core/random.hpp"
#include "slave/simulation/scene/yielding.hpp"
#include "tests/support/allocations.hpp"

namespace longreach::scene_test {
namespace {

SceneConfig wall(double stiffness, double exponent, double damping) {
  SceneConfig scene;
  scene.material = {{"m", stiffness, 1e-3, exponent, damping}};
  scene.surface = {{"s", "m", PlaneConfig{Vector3(0.2, 0, 0), Vector3(-2, 0, 0), true}}};
  return scene;
}

Pose at(const Vector3& p) { return {p, Quaternion::Identity()}; }

TEST(Scene, FollowsHuntAndCrossleyInClosedForm) {
  const Vector3 start(11, 0, 2);
  for (const double n : {1.0, 1.5, 3.0}) {
    const Scene scene(wall(1000.0, n, 0.5), at(start));
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
  const Scene scene(wall(1e6, 1.5, 100.0), Pose{});
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
  config.surface.push_back({"floor", "m", PlaneConfig{Vector3(0, 0, 1), Vector3::UnitZ(), false}});
  const Scene scene(config, Pose{});
  const SceneContact c = scene.contact({Vector3(0.201, 0, 0.998), Vector3::Zero()});
  EXPECT_NEAR((c.force_n - Vector3(-1.0, 0, 2.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(c.surface, 1);
}

TEST(Scene, RefusesWhatItCannotBuild) {
  SceneConfig config = wall(1000.0, 1.0, 0.0);
  config.surface[0].material = "cheese";
  EXPECT_THROW(Scene(config, Pose{}), std::invalid_argument);
  config = wall(1000.0, 1.0, 0.0);
  config.surface[0].plane->normal.setZero();
  EXPECT_THROW(Scene(config, Pose{}), std::invalid_argument);
  config = wall(1000.0, 1.0, 0.0);
  config.path = PathConfig{.waypoint = {{{0, 0, 0}}, {{0.1, 0, 0}}, {{0.1, 0.1, 0}}}, .turn_radius_m = 0.11};
  EXPECT_THROW(Scene(config, Pose{}), std::invalid_argument);
  config.path->turn_radius_m = 0.1;
  EXPECT_NO_THROW(Scene(config, Pose{}));
}

TEST(Scene, FeelsNothingWhereThereIsNoNumber) {
  const Scene scene(wall(1000.0, 1.5, 0.1), Pose{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scene.contact({Vector3(nan, 0, 0), Vector3::Zero()}).force_n, Vector3::Zero().eval());
  EXPECT_EQ(scene.contact({Vector3(0.3, 0, 0), Vector3(nan, 0, 0)}).force_n, Vector3::Zero().eval());
  EXPECT_EQ(Scene(SceneConfig{}, Pose{}).contact({}).surface, -1);
}

SceneConfig scene_of(const std::vector<SurfaceConfig>& surfaces, double exponent = 1.5,
                     double damping = 0.0) {
  SceneConfig scene = wall(1000.0, exponent, damping);
  scene.surface = surfaces;
  return scene;
}

SurfaceConfig box(const Vector3& centre, const Vector3& size, const std::string& body = "") {
  SurfaceConfig surface{.name = "box", .material = "m"};
  surface.box = BoxConfig{centre, size, Vector3::Zero(), false};
  surface.body = body;
  return surface;
}

Vector3 normal3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

// A sphere of 1 cm on an edge of a box: pushed away from the edge, at any angle between the faces.
TEST(Scene, RoundsEdgesWithTheToolsRadius) {
  SceneConfig config = scene_of({box(Vector3(-0.5, -0.5, 0), Vector3(1, 1, 1))}, 1.0);
  config.tool_radius_m = 0.01;
  const Scene scene(config, Pose{});
  for (double angle = 0.01; angle < 1.56; angle += 0.05) {
    const Vector3 way(std::cos(angle), std::sin(angle), 0);
    const SceneContact c = scene.contact({0.008 * way, Vector3::Zero()});
    EXPECT_NEAR((c.force_n - 2.0 * way).norm(), 0.0, 1e-9);
    EXPECT_NEAR((c.normal - way).norm(), 0.0, 1e-12);
    EXPECT_EQ(c.contacts, 1);
  }
}

TEST(Scene, PushesFromBothWallsOfACorner) {
  SurfaceConfig floor{.name = "floor", .material = "m"}, front{.name = "front", .material = "m"};
  floor.plane = PlaneConfig{Vector3::Zero(), Vector3::UnitZ(), false};
  front.plane = PlaneConfig{Vector3::Zero(), Vector3(-1, 0, 1), false};
  const SceneContact c = Scene(scene_of({floor, front}, 1.0), Pose{}).contact({Vector3(0, 0, -0.001), {}});
  const double s = std::sqrt(0.5);
  EXPECT_NEAR((c.force_n - Vector3(-s * s, 0, 1 + s * s)).norm(), 0.0, 1e-9);
  EXPECT_EQ(c.contacts, 2);
  EXPECT_EQ(c.surface, 0);
}

// Two boxes that overlap, as one body: only the deeper one pushes; on their own both do.
TEST(Scene, HasNoForceTwiceInsideAUnion) {
  const SurfaceConfig left = box(Vector3(-0.4, 0, 0), Vector3(1, 1, 1)),
                      right = box(Vector3(0.4, 0, 0), Vector3(1, 1, 1));
  SurfaceConfig one = left, other = right;
  one.body = other.body = "beam";
  const ToolMotion middle{Vector3(0, 0, 0.498), Vector3::Zero()};
  const SceneContact united = Scene(scene_of({one, other}, 1.0), Pose{}).contact(middle);
  EXPECT_NEAR(united.force_n.z(), 2.0, 1e-9);
  EXPECT_EQ(united.contacts, 1);
  EXPECT_EQ(united.asked, 2);
  EXPECT_NEAR(Scene(scene_of({left, right}, 1.0), Pose{}).contact(middle).force_n.z(), 4.0, 1e-9);
}

// The elastic force of any scene is the slope of its energy, so that no way around gains any.
TEST(Scene, ElasticForceHasAnEnergy) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    std::vector<SurfaceConfig> surfaces;
    for (int i = 0; i < 6; ++i) {
      SurfaceConfig s{.name = std::to_string(i), .material = "m"};
      const Vector3 centre = 0.3 * normal3(random);
      if (i % 3 == 0) s.sphere = SphereConfig{centre, random.uniform(0.2, 0.5), false};
      if (i % 3 == 1)
        s.cylinder = CylinderConfig{centre, normal3(random), random.uniform(0.2, 0.5),
                                    random.uniform(0.3, 1.0), false};
      if (i % 3 == 2) s.box = BoxConfig{centre, Vector3(0.5, 0.7, 0.9), normal3(random), false};
      s.body = i < 4 ? "united" : "";
      surfaces.push_back(s);
    }
    const Scene scene(scene_of(surfaces), Pose{});
    // Once around a triangle, in steps so short that the work of the mean force is the energy.
    const Vector3 corner[3] = {0.3 * normal3(random), 0.3 * normal3(random), 0.3 * normal3(random)};
    constexpr int kSteps = 20000;
    double work = 0.0, most = 0.0;
    Vector3 before = scene.contact({corner[0], Vector3::Zero()}).force_n;
    for (int edge = 0; edge < 3; ++edge) {
      const Vector3 way = (corner[(edge + 1) % 3] - corner[edge]) / kSteps;
      for (int i = 1; i <= kSteps; ++i) {
        const Vector3 force = scene.contact({corner[edge] + i * way, Vector3::Zero()}).force_n;
        work += 0.5 * (before + force).dot(way);
        most = std::max(most, std::abs(work));
        before = force;
      }
    }
    ASSERT_NEAR(work, 0.0, 2e-3 * (most + 1.0)) << seed;
  }
}

TEST(Scene, FollowsASurfaceThatMoves) {
  SurfaceConfig piston{.name = "piston", .material = "m"};
  piston.plane = PlaneConfig{Vector3::Zero(), Vector3::UnitZ(), false};
  piston.movement = MovementConfig{Vector3(0, 0, 0.01), Vector3(0, 0, 0.002), 3.0};
  const Scene scene(scene_of({piston}, 1.0, 2.0), Pose{});
  for (double t = 0.0; t < 1.0; t += 0.01) {
    const double angle = 2.0 * std::numbers::pi * 3.0 * t;
    const double z = 0.01 * t + 0.002 * std::sin(angle);
    const double v = 0.01 + 0.002 * 2.0 * std::numbers::pi * 3.0 * std::cos(angle);
    const SceneContact c = scene.contact({.p_WE = Vector3(0, 0, z - 0.001), .t_s = t});
    EXPECT_NEAR(c.force_n.z(), 1.0 + 2.0 * v, 1e-9) << t;
  }
}

// A turn about the axis is resisted by a moment of k arm²; a turn about another one, or the other way, is
// free.
TEST(Scene, StopsATurnAboutAHinge) {
  SurfaceConfig stop{.name = "stop", .material = "m"};
  stop.hinge = HingeConfig{Vector3(0, 0, 2), 0.05, 0.1};
  const Quaternion start = exp_rotation(Vector3(0.3, -1.0, 2.0));
  const Scene scene(scene_of({stop}, 1.0, 0.5), {Vector3::Zero(), start});
  const auto moment = [&](const Vector3& turn, const Vector3& rad_per_s) {
    return scene.contact({.q_WE = exp_rotation(turn) * start, .w_WE = rad_per_s}).moment_nm;
  };
  EXPECT_NEAR((moment(Vector3(0, 0, 0.09), Vector3::Zero()) - Vector3(0, 0, -0.4)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(moment(Vector3(0, 0, 0.09), Vector3(0, 0, 2)).z(), -0.4 * (1.0 + 0.5 * 0.2), 1e-9);
  EXPECT_EQ(moment(Vector3(0, 0, 0.04), Vector3::Zero()).norm(), 0.0);
  EXPECT_EQ(moment(Vector3(0, 0, -0.5), Vector3::Zero()).norm(), 0.0);
  EXPECT_EQ(moment(Vector3(0.7, 0.4, 0), Vector3::Zero()).norm(), 0.0);
  EXPECT_EQ(scene.contact({.q_WE = exp_rotation(Vector3(0, 0, 0.09)) * start}).force_n.norm(), 0.0);
}

// Around any closed turn the elastic moment of a hinge does no work, also when the turn is not about its
// axis.
TEST(Scene, ElasticMomentHasAnEnergy) {
  SurfaceConfig stop{.name = "stop", .material = "m"};
  stop.hinge = HingeConfig{Vector3(1, 2, 3), 0.1, 0.1};
  const Scene scene(scene_of({stop}), Pose{});
  Random random(9);
  for (int seed = 0; seed < 20; ++seed) {
    const Vector3 a = 0.5 * normal3(random), b = 0.5 * normal3(random);
    const auto turn = [&](double s) { return exp_rotation(std::sin(s) * a + (1.0 - std::cos(s)) * b); };
    double work = 0.0, most = 0.0;
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double s = 2.0 * std::numbers::pi * i / kSteps, ds = 2.0 * std::numbers::pi / kSteps;
      const Vector3 by = log_rotation(turn(s + ds) * turn(s).conjugate());
      work += scene.contact({.q_WE = turn(s + 0.5 * ds)}).moment_nm.dot(by);
      most = std::max(most, std::abs(work));
    }
    EXPECT_NEAR(work, 0.0, 1e-4 * most + 1e-12) << seed;
  }
}

// Many bodies: the same as all of them asked one after the other, and few are asked.
TEST(Scene, AsksFewOfManySurfaces) {
  Random random(5);
  std::vector<SurfaceConfig> surfaces;
  for (int i = 0; i < 10000; ++i) {
    SurfaceConfig s{.name = std::to_string(i), .material = "m"};
    s.sphere = SphereConfig{Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)),
                            0.03, false};
    surfaces.push_back(s);
  }
  const Scene scene(scene_of(surfaces), Pose{});
  std::vector<Scene> alone;
  for (const SurfaceConfig& s : surfaces) alone.emplace_back(scene_of({s}), Pose{});
  int touched = 0;
  for (int i = 0; i < 100; ++i) {
    const ToolMotion tool{Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)),
                          normal3(random)};
    Vector3 expected = Vector3::Zero();
    int contacts = 0;
    for (const Scene& one : alone) {
      const SceneContact c = one.contact(tool);
      expected += c.force_n;
      contacts += c.contacts;
    }
    const SceneContact c = scene.contact(tool);
    EXPECT_NEAR((c.force_n - expected).norm(), 0.0, 1e-9);
    EXPECT_EQ(c.contacts, contacts);
    EXPECT_LE(c.asked, 40);
    touched += contacts;
  }
  EXPECT_GT(touched, 5);
}

TEST(Scene, AllocatesNothingInAStep) {
  const Scene scene(
      scene_of({box(Vector3(-0.4, 0, 0), Vector3(1, 1, 1)), box(Vector3(0.4, 0, 0), Vector3(1, 1, 1))}),
      Pose{});
  const ToolMotion from{Vector3(0, 0, 0.499), Vector3::Zero()}, free{Vector3(0, 0, 0.498), Vector3::Zero()};
  Compliance compliance = Compliance::Zero();
  compliance.bottomRightCorner<3, 3>().diagonal().setConstant(1e-6);
  test::count_allocations(true);
  const SceneContact touching = scene.contact(free);
  const Yielded tool = yield(scene, from, free, compliance, 1e-3);
  test::count_allocations(false);
  EXPECT_EQ(test::allocations(), 0);
  EXPECT_EQ(touching.contacts, 2);
  EXPECT_TRUE(tool.converged && tool.wrench[5] > 0.0);
}

}  // namespace
}  // namespace longreach::scene_test
