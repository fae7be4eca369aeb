#include "deploy/lab/person/person_scenes.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kAnswer_s = 0.3;  // response time in addition to the one-way delay

/// Sets the stiffness of the only material of the scene.
std::string material(PersonScenario& s, double stiffness_n_per_m) {
  s.slave.scene.material.resize(1);
  s.slave.scene.material[0].stiffness_n_per_m = stiffness_n_per_m;
  return s.slave.scene.material[0].name;
}

}  // namespace

void clear(PersonScenario& s) { s.slave.scene.surface.clear(); }

void in_mode(PersonScenario& s, MotionMode mode) { s.master.mapping.mode = mode; }

void add_wall(PersonScenario& s, double x_m, double stiffness_n_per_m, const Vector3& normal) {
  SurfaceConfig wall;
  wall.name = "wall" + std::to_string(s.slave.scene.surface.size());
  wall.material = material(s, stiffness_n_per_m);
  wall.plane = PlaneConfig{.point_m = {x_m, 0.0, 0.0}, .normal = normal};
  s.slave.scene.surface.push_back(wall);
  s.depth_m = [x_m, out = Vector3(normal.normalized())](const Vector3& p) {
    return out.dot(Vector3(x_m, 0.0, 0.0) - p);
  };
}

void only_wall(PersonScenario& s, double x_m, double stiffness_n_per_m) {
  clear(s);
  add_wall(s, x_m, stiffness_n_per_m);
}

void only_box(PersonScenario& s, const Vector3& centre_m, const Vector3& size_m, double stiffness_n_per_m) {
  clear(s);
  SurfaceConfig box;
  box.name = "box";
  box.material = material(s, stiffness_n_per_m);
  box.box = BoxConfig{.centre_m = centre_m, .size_m = size_m};
  s.slave.scene.surface.push_back(box);
  const double face_m = centre_m.x() - 0.5 * size_m.x();
  s.depth_m = [face_m](const Vector3& p) { return p.x() - face_m; };
}

double commanded_n(const PersonScenario& s, double deflection_m) {
  constexpr double kSlope_n_per_m = 200.0;
  const double guarded_n = s.master.rendering.rate_force_ratio * s.slave.command.force_guard_n;
  return std::min(kSlope_n_per_m * std::max(0.0, deflection_m - s.master.mapping.dead_zone_m), guarded_n);
}

double one_way(const PersonScenario& s) { return 0.5 * s.rtt_s; }

PersonCheck answers(const PersonScenario& s, const MoveSeen& retreat) {
  return {"response time to a retreat, s", retreat.answer_s < 0.0 ? 1e3 : retreat.answer_s,
          one_way(s) + kAnswer_s};
}
PersonCheck lead_before(const PersonScenario& s, const PersonSeen& seen, std::size_t move) {
  return {"lead of the goal over the tool before the report arrives, m", seen.move[move].lead_max_m,
          seen.goal_m_per_s * (s.rtt_s + kAnswer_s) + kMostLead_m};
}
PersonCheck lead_after(const PersonSeen& seen, std::size_t move) {
  return {"lead of the goal over the tool after the report has arrived, m", seen.move[move].lead_m,
          kMostLead_m};
}
PersonCheck in_front(const PersonSeen& seen) {
  return {"contact force while the goal is in front of all surfaces, N", seen.front_n, kNothing_n};
}

}  // namespace longreach
