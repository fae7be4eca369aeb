// Surroundings that change while the robot is in them.

#include <cmath>
#include <numbers>

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

constexpr double kAhead_m = 2e-3;

bool touches(const World& world) { return !world.scenario().slave.scene.material.empty(); }

void as_it_was(World& world, Active&) { world.surround(world.scenario().slave.scene); }

/// A wall of the scene's first material, so far ahead of the tool, that comes; besides what is there, or
/// alone.
void wall_ahead(World& world, Active& fault, double ahead_m, double m_per_s, bool alone) {
  SceneConfig scene = world.scenario().slave.scene;
  const Vector3 normal =
      Vector3(fault.random.normal(), fault.random.normal(), fault.random.normal()).normalized();
  SurfaceConfig wall;
  wall.name = "appeared";
  wall.material = scene.material.front().name;
  wall.plane = PlaneConfig{world.moment().X_WE.p - ahead_m * normal, normal, false};
  if (m_per_s > 0.0) {
    wall.movement = MovementConfig{m_per_s * normal};
    wall.plane->point_m -= world.moment().t_s * m_per_s * normal;
  }
  if (alone) scene.surface.clear();
  scene.surface.push_back(wall);
  world.surround(scene);
}
void appear(World& world, Active& fault) {
  if (fault.begins && touches(world))
    wall_ahead(world, fault, log_scale(fault.fault.size, 1e-4, 0.02), 0.0, false);
}
/// Till the way that the robot may give is used up.
void come_far(World& world, Active& fault) {
  if (fault.begins && touches(world))
    wall_ahead(world, fault, kAhead_m, log_scale(fault.fault.size, 0.02, 0.05), true);
}
void vanish(World& world, Active& fault) {
  if (!fault.begins) return;
  SceneConfig scene = world.scenario().slave.scene;
  scene.surface.clear();
  world.surround(scene);
}
/// To and fro, from where it is.
void move(World& world, Active& fault) {
  if (!fault.begins || !touches(world)) return;
  SceneConfig scene = world.scenario().slave.scene;
  for (SurfaceConfig& surface : scene.surface) {
    if (!surface.plane) continue;
    MovementConfig movement;
    movement.amplitude_m = log_scale(fault.fault.size, 1e-3, 0.02) * surface.plane->normal.normalized();
    movement.frequency_hz = log_scale(fault.random.uniform(), 0.1, 1.0);
    const double phase = 2.0 * std::numbers::pi * movement.frequency_hz * world.moment().t_s;
    surface.plane->point_m -= std::sin(phase) * movement.amplitude_m;
    surface.movement = movement;
  }
  world.surround(scene);
}
/// Towards the tool, from where it is.
void come(World& world, Active& fault) {
  if (!fault.begins || !touches(world)) return;
  SceneConfig scene = world.scenario().slave.scene;
  for (SurfaceConfig& surface : scene.surface) {
    if (!surface.plane) continue;
    MovementConfig movement;
    movement.velocity_m_per_s = log_scale(fault.fault.size, 1e-3, 0.05) * surface.plane->normal.normalized();
    surface.plane->point_m -= world.moment().t_s * movement.velocity_m_per_s;
    surface.movement = movement;
  }
  world.surround(scene);
}
void change_stiffness(World& world, double by) {
  SceneConfig scene = world.scenario().slave.scene;
  for (MaterialConfig& material : scene.material) material.stiffness_n_per_m *= by;
  world.surround(scene);
}
void stiffen(World& world, Active& fault) {
  if (fault.begins) change_stiffness(world, log_scale(fault.fault.size, 2.0, 1000.0));
}
void soften(World& world, Active& fault) {
  if (fault.begins) change_stiffness(world, log_scale(fault.fault.size, 1e-3, 0.5));
}

constexpr std::string_view kGroup = "contact";
constexpr auto kScene = only(AffectedSignal::kScene);

const FaultKind kKinds[] = {
    {.name = "surface-appears", .group = kGroup, .affects = kScene, .act = appear, .end = as_it_was},
    {.name = "surface-vanishes", .group = kGroup, .affects = kScene, .act = vanish, .end = as_it_was},
    {.name = "surface-moves", .group = kGroup, .affects = kScene, .act = move, .end = as_it_was},
    {.name = "surface-comes", .group = kGroup, .affects = kScene, .act = come, .end = as_it_was},
    {.name = "surface-comes-far",
     .group = kGroup,
     .affects = kScene,
     .longest_s = 10.0,
     .shortest_s = 4.0,
     .besides = 0.15,
     .act = come_far,
     .end = as_it_was},
    {.name = "surface-stiffens", .group = kGroup, .affects = kScene, .act = stiffen, .end = as_it_was},
    {.name = "surface-softens", .group = kGroup, .affects = kScene, .act = soften, .end = as_it_was},
};

}  // namespace

std::span<const FaultKind> contact_kinds() { return kKinds; }

}  // namespace longreach
