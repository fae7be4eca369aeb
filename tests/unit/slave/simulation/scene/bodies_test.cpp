#include "slave/simulation/scene/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "tests/unit/slave/simulation/scene/bodies_scene.hpp"

namespace longreach::bodies_test {
namespace {

using namespace test;

// A closed room of boxes about two tumbling bodies.
std::string room() {
  std::string walls;
  const char* places[] = {"0.9 0 0", "-0.9 0 0", "0 0.9 0", "0 -0.9 0", "0 0 0.9", "0 0 -0.9"};
  for (const char* at : places)
    walls += std::string("<geom type='box' size='0.5 0.5 0.5' material='hard' pos='") + at + "'/>\n";
  return walls;
}

struct Total {
  Vector3 momentum = Vector3::Zero(), spin = Vector3::Zero();
};

Total total(const Bodies& bodies) {
  Total t;
  for (int i = 0; i < bodies.count(); ++i) {
    const RigidState& s = bodies.state(i);
    const Vector3 p = bodies.body(i).mass.mass_kg * s.v_m_per_s;
    t.momentum += p;
    t.spin += s.spin_kg_m2_per_s + s.X.p.cross(p);
  }
  return t;
}

// The exact motion of a free symmetric top: the axis turns about the angular momentum at L/I.
TEST(Bodies, TumbleAsATopDoes) {
  Bodies bodies(scene_of(kTool + "<body name='a' pos='1 0 0'><freejoint/><inertial mass='10' pos='0 0 0' "
                                 "diaginertia='2 2 3'/></body>"),
                Pose{});
  bodies.push(0, {0.1, 0.0, 0.0}, {0.4, 0.0, 1.0});
  const double energy = bodies.energy_j();
  const Vector3 L(0.8, 0.0, 3.0);
  for (int i = 0; i < 20000; ++i) bodies.step(Pose{}, 1e-3);
  const double angle = L.norm() / 2.0 * 20.0;
  const Vector3 axis = exp_rotation(angle * L.normalized()) * Vector3::UnitZ();
  const Pose moved = bodies.displaced(0);
  EXPECT_LT((moved.q * Vector3::UnitZ() - axis).norm(), 1e-5);
  EXPECT_NEAR(moved.p.x(), 2.0, 1e-11);
  EXPECT_NEAR(bodies.energy_j(), energy, 1e-12 * energy);
}

// The frame of the body in the file, not that of its centre of mass, in which the motion is computed.
TEST(Bodies, PosesAreThoseOfTheFramesInTheFile) {
  const Pose start{{0.5, -1.0, 2.0}, exp_rotation({0.3, 0.2, 0.1})};
  Bodies bodies(scene_of(kTool + "<body name='a' pos='1 2 3' quat='0 0 0.6 0.8'><freejoint/>"
                                 "<geom type='box' size='0.1 0.2 0.3' mass='2' material='hard' pos='0.4 0 0' "
                                 "euler='10 20 30'/></body>"),
                start);
  const Pose begun = bodies.pose(0);
  EXPECT_LT((begun.p - Vector3(1.5, 1.0, 5.0)).norm(), 1e-12);
  EXPECT_LT(begun.q.angularDistance(Quaternion(0.0, 0.0, 0.6, 0.8)), 1e-7);
  bodies.push(0, {0.1, 0.0, -0.2}, {0.3, -0.4, 0.5});
  for (int i = 0; i < 2000; ++i) bodies.step(start, 1e-3);
  // Two points that are fixed to the body tell the same motion: its centre of mass and its frame.
  const Pose moved = bodies.displaced(0), now = bodies.pose(0);
  const Vector3 centre = start.p + bodies.body(0).X_start.p;
  EXPECT_GT(log_rotation(moved.q).norm(), 0.5);
  EXPECT_LT((now.p - (centre + moved.p + moved.q * (begun.p - centre))).norm(), 1e-9);
  EXPECT_LT(now.q.angularDistance(moved.q * begun.q), 1e-7);
}

// Without damping, two stars that knock about in a room keep their energy and, while they meet only each
// other, their momentum.
TEST(Bodies, CollisionsKeepEnergyAndMomentum) {
  for (const double stiffness : {1e3, 1e5, 1e7, 1e9}) {
    Bodies bodies(scene_of(kTool + star("a", "1 0 0") + star("b", "2 0.05 0.02"), stiffness), Pose{});
    bodies.push(0, {1.0, 0.0, 0.0}, {0.3, 2.0, -1.0});
    bodies.push(1, {-0.5, 0.0, 0.0}, {-1.0, 0.5, 0.7});
    const double energy = bodies.energy_j();
    const Total before = total(bodies);
    int touched = 0;
    for (int i = 0; i < 3000; ++i) {
      bodies.step(Pose{}, 1e-3);
      touched += bodies.contact().contacts > 0;
      ASSERT_NEAR(bodies.energy_j(), energy, 1e-9 * energy) << stiffness << " step " << i;
    }
    EXPECT_GT(touched, 0);
    EXPECT_EQ(bodies.unconverged(), 0U);
    const Total after = total(bodies);
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-9);
    EXPECT_LT((after.spin - before.spin).norm(), 1e-9);
  }
}

// Damped contacts only lose energy, however many there are at once.
TEST(Bodies, KnockAboutInARoomWithoutGainingEnergy) {
  int most = 0;
  for (const double stiffness : {3e2, 1e4, 1e6, 1e8}) {
    Bodies bodies(scene_of(room() + star("a", "0.15 0.1 0") + star("b", "-0.15 -0.1 0.05") +
                               "<body name='tool' pos='5 0 0'><freejoint/><geom size='0.02' mass='1' "
                               "material='hard'/></body>",
                           stiffness, 0.05),
                  kAway);
    bodies.push(0, {1.0, 0.7, 0.3}, {3.0, 2.0, -1.0});
    bodies.push(1, {-0.5, 0.4, 0.2}, {-1.0, 5.0, 0.7});
    const double first = bodies.energy_j();
    double energy = first, rise = 0.0;
    for (int i = 0; i < 5000; ++i) {
      most = std::max(most, bodies.step(kAway, 1e-3).contacts);
      rise = std::max(rise, bodies.energy_j() - energy);
      energy = std::min(energy, bodies.energy_j());
    }
    EXPECT_LT(rise, 1e-12 * first);
    EXPECT_LT(energy, 0.95 * first);
    EXPECT_EQ(bodies.unconverged(), 0U);
  }
  EXPECT_GE(most, 2);
}

// What the tool does to a body it also pays for, and what it feels is what the body gets.
TEST(Bodies, TheToolPushesWithoutCreatingEnergy) {
  Bodies bodies(scene_of(kTool + star("a", "0.2 0.01 0"), 1e4, 0.3), Pose{});
  Pose tool;
  Vector3 impulse = Vector3::Zero();
  bool touched = false;
  for (int i = 0; i < 2000; ++i) {
    tool.p.x() = i < 1000 ? 1e-4 * i : 0.1;
    const BodiesContact& c = bodies.step(tool, 1e-3);
    impulse -= 1e-3 * c.F_E_W.force;
    touched = touched || c.contacts > 0;
    ASSERT_LE(bodies.energy_j(), bodies.tool_work_j() + 1e-14);
    if (touched && c.contacts > 0) {
      ASSERT_LE(c.F_E_W.force.x(), 1e-12);
    }
  }
  EXPECT_TRUE(touched);
  const RigidState& a = bodies.state(0);
  EXPECT_GT(a.v_m_per_s.x(), 0.1);
  EXPECT_LT((impulse - bodies.body(0).mass.mass_kg * a.v_m_per_s).norm(), 1e-9);
}

const std::string kLoad =
    "<body name='load' pos='0.1 0 0'><freejoint/><geom type='box' size='0.05 0.1 0.1' mass='30' "
    "contype='0' conaffinity='0'/><site name='fixture' pos='-0.1 0.01 0'/></body>\n";

// A load on the tool follows it, and weighs on it with its own inertia.
TEST(Bodies, AGraspedLoadFollowsTheToolAndWeighsOnIt) {
  Bodies bodies(with_gripper(kTool + kLoad), Pose{});
  bodies.grip(true);
  Pose tool;
  for (int i = 0; i <= 4000; ++i) {
    const double t = 1e-3 * i, a = 0.05;
    tool.p.y() = 0.5 * a * t * t;
    const BodiesContact& c = bodies.step(tool, 1e-3);
    ASSERT_LE(bodies.energy_j(), bodies.tool_work_j() + 1e-12);
    if (i < 3000) continue;
    EXPECT_TRUE(c.holds);
    EXPECT_NEAR(c.F_E_W.force.y(), -30.0 * a, 0.03);
    EXPECT_NEAR(c.F_E_W.moment.z(), -30.0 * a * 0.1, 0.03);
  }
  EXPECT_NEAR(bodies.displaced(0).p.y(), tool.p.y(), 1e-3);
  bodies.grip(false);
  const double v = bodies.state(0).v_m_per_s.y();
  for (int i = 0; i < 1000; ++i) bodies.step(tool, 1e-3);
  EXPECT_FALSE(bodies.contact().holds);
  EXPECT_NEAR(bodies.state(0).v_m_per_s.y(), v, 1e-2);
  EXPECT_TRUE(bodies.contact().F_E_W.force.isZero(0.0));
}

TEST(Bodies, NothingIsGraspedOutOfReachOrAskew) {
  for (const Pose& tool : {Pose{{0.0, 0.035, 0.0}, Quaternion::Identity()},
                           Pose{Vector3::Zero(), exp_rotation({0.0, 0.2, 0.0})}}) {
    Bodies bodies(with_gripper(kTool + kLoad), Pose{});
    bodies.step(tool, 1.0);
    bodies.grip(true);
    bodies.step(tool, 1e-3);
    EXPECT_FALSE(bodies.contact().holds);
    bodies.step(Pose{}, 1.0);
    EXPECT_TRUE(bodies.contact().holds);
  }
}

SceneConfig with_latch() {
  SceneConfig scene =
      with_gripper(kTool +
                   "<body name='load' pos='0.1 0 0'><freejoint/><geom name='striker' size='0.05' mass='30' "
                   "material='hard'/><site name='fixture' pos='-0.1 0 0'/></body>\n"
                   "<geom name='keeper' type='box' size='0.01 0.1 0.1' pos='0.18 0 0' material='soft'/>\n"
                   "<geom name='seat' type='box' size='0.01 0.1 0.1' pos='0.21 0 0' material='hard'/>\n");
  scene.bodies->file[0].text.insert(scene.bodies->file[0].text.find("<material"), "<material name='soft'/>");
  scene.material.push_back({"soft", 3000.0, 0.001, 1.0, 0.1});
  scene.bodies->latch.emplace();
  scene.bodies->latch->bond.play_m = 0.01;
  return scene;
}

// Success is a force that rises and vanishes; then the striker is held.
TEST(Bodies, ALatchResistsThenGivesWayAndHolds) {
  Bodies bodies(with_latch(), Pose{});
  bodies.grip(true);
  Pose tool;
  double peak = 0.0;
  int latched_at = -1, i = 0;
  for (; i < 30000 && latched_at < 0; ++i) {
    tool.p.x() += 2e-6;
    const BodiesContact& c = bodies.step(tool, 1e-3);
    peak = std::max(peak, -c.F_E_W.force.x());
    ASSERT_LE(bodies.energy_j() + bodies.spent_j(), bodies.tool_work_j() + 1e-12);
    if (c.latched) latched_at = i;
  }
  ASSERT_GT(latched_at, 0);
  EXPECT_NEAR(peak, 12.0, 0.5);  // 4 mm of 3000 N/m
  for (i = 0; i < 1500; ++i) {
    tool.p.x() += 2e-6;
    bodies.step(tool, 1e-3);
    ASSERT_LE(bodies.energy_j() + bodies.spent_j(), bodies.tool_work_j() + 1e-12);
  }
  EXPECT_LT(bodies.contact().F_E_W.force.norm(), 0.1);
  bodies.grip(false);
  bodies.push(0, {-0.05, 0.01, 0.0}, Vector3::Zero());
  for (i = 0; i < 20000; ++i) bodies.step(Pose{}, 1e-3);
  EXPECT_LT((bodies.displaced(0).p - Vector3(0.024, 0.0, 0.0)).norm(), 0.02);
}

// A closed mesh of triangles: mass by its volume, contact by its faces.
TEST(Bodies, AMeshHasItsVolumesMassAndPushesWithItsFaces) {
  SceneConfig scene =
      scene_of(kTool +
               "<body name='a' pos='0.22 0 0'><freejoint/><geom type='mesh' mesh='cube' density='500' "
               "material='hard'/></body>\n");
  std::string& text = scene.bodies->file[0].text;
  text.insert(text.find("<material"), "<mesh name='cube' file='cube.obj'/>");
  scene.bodies->file.push_back(
      {"cube.obj",
       "v -.1 -.1 -.1\nv .1 -.1 -.1\nv .1 .1 -.1\nv -.1 .1 -.1\nv -.1 -.1 .1\nv .1 -.1 .1\nv .1 .1 .1\n"
       "v -.1 .1 .1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"});
  Bodies bodies(scene, Pose{});
  EXPECT_NEAR(bodies.body(0).mass.mass_kg, 4.0, 1e-6);
  EXPECT_LT((bodies.body(0).mass.inertia_kg_m2 - Vector3::Constant(4.0 * 0.04 / 6.0)).norm(), 1e-6);
  Pose tool;
  for (int i = 0; i < 3000; ++i) {
    tool.p.x() = std::min(0.12, 1e-4 * i);
    bodies.step(tool, 1e-3);
    ASSERT_LE(bodies.energy_j(), bodies.tool_work_j() + 1e-6);
  }
  EXPECT_NEAR(bodies.state(0).v_m_per_s.x(), 0.2, 0.005);  // twice the tool's: nothing is lost
  EXPECT_LT(bodies.state(0).v_m_per_s.tail<2>().norm(), 1e-3);
}

}  // namespace
}  // namespace longreach::bodies_test
