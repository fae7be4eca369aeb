// Shapes other than one wall: corners, a groove, and an edge. The hand at rest must feel the force of the tool, in size and
// direction.

#include <algorithm>
#include <cmath>

#include "deploy/lab/person/person_scenes.hpp"

namespace longreach {
namespace {

constexpr double kAt_m = 0.02;  // distance of the walls from the start
constexpr double kStep_n = 0.3;

void start(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kPosition);
  s.master.mapping.scale = 1.0;
}

void rest_at(PersonScenario& s, std::vector<Vector3> places_m) {
  for (const Vector3& to_m : places_m) s.moves.push_back({.to_m = to_m, .wait_s = 5.0, .wait_rtt = 2.0});
}

/// At the end of this move the hand feels the force of the tool.
PersonChecks felt_as_it_is(const PersonScenario& s, const MoveSeen& m, double least_n = 0.5) {
  const Vector3 due_n = m.tool_force_n / s.master.mapping.scale;
  return {{"shortfall of the tool force below the required minimum, N", least_n - m.tool_n, 0.0},
          {"difference between the hand force and the tool force, N", (m.felt - due_n).norm(),
           kTolerance * due_n.norm() + kNoise_n},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kSteady_n},
          {"maximum rise of the force in one tick, N", m.felt_step_n, kStep_n}};
}
PersonChecks judge_last(const PersonScenario& s, const PersonSeen& seen) {
  return felt_as_it_is(s, seen.move.back());
}

// Two walls, x and y.
void corner(PersonScenario& s, std::vector<Vector3> places_m) {
  start(s);
  add_wall(s, kAt_m, 1000.0);
  add_wall(s, kAt_m, 1000.0, -Vector3::UnitY());
  s.slave.scene.surface.back().plane->point_m = {0.0, kAt_m, 0.0};
  rest_at(s, std::move(places_m));
}
void corner_at_once(PersonScenario& s) {
  corner(s, {{0.03, 0.029, 0.0}, Vector3::Zero(), {0.03, 0.029, 0.0}});
}
// The second wall is learnt late, and the store of energy was spent at the first: once more from in front of it.
void corner_by_sliding(PersonScenario& s) {
  corner(s, {{0.03, 0.0, 0.0}, {0.03, 0.03, 0.0}, {0.03, 0.0, 0.0}, {0.03, 0.03, 0.0}});
}
void corner_by_walls(PersonScenario& s) {
  corner(s, {{0.03, 0.0, 0.0}, Vector3::Zero(), {0.0, 0.03, 0.0}, Vector3::Zero(), {0.028, 0.03, 0.0}});
}

// A groove of 60 degrees along z, whose bottom is at 30 mm: pressed in the middle, then against one side.
void groove(PersonScenario& s) {
  start(s);
  for (const double side : {1.0, -1.0}) {
    add_wall(s, 0.0, 1000.0, {-0.5, -side * std::sqrt(0.75), 0.0});
    s.slave.scene.surface.back().plane->point_m = {0.03, 0.0, 0.0};
  }
  rest_at(s, {{0.04, 0.002, 0.0}, {0.036, 0.014, 0.0}, {0.038, -0.012, 0.0}});
}

// Slides off the edge of a box and rests in the air beside it.
void edge(PersonScenario& s, double scale) {
  only_box(s, {kAt_m + 0.02, 0.0, 0.0}, Vector3::Constant(0.04), 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.master.mapping.scale = scale;
  SurfaceConfig& box = s.slave.scene.surface.back();
  box.box->centre_m = scale * Vector3(kAt_m, 0.0, 0.0) + Vector3(0.02, scale * kAt_m - 0.02, 0.0);
  rest_at(s, {{0.03, 0.0, 0.0}, {0.03, 0.015, 0.0}, {0.03, 0.04, 0.0}});
}
PersonChecks judge_edge(const PersonScenario&, const PersonSeen& seen) {
  return {{"shortfall of the tool force below the required minimum, N", 0.3 - seen.move[0].tool_n, 0.0},
          {"force at the hand beside the box, N", seen.move[2].felt_n, kNoise_n},
          {"maximum rise of the force in one tick, N", seen.move[2].felt_step_n, kStep_n}};
}

}  // namespace

void add_shapes(std::vector<PersonRow>& rows) {
  const std::vector<PersonRow> more = {
      {"corner-at-once", "presses into a corner twice, both walls at once", corner_at_once, judge_last},
      {"corner-by-sliding", "presses on a wall and slides along it into a corner, twice", corner_by_sliding,
       judge_last},
      {"corner-by-walls", "presses on each wall of a corner, then into the corner", corner_by_walls,
       judge_last},
      {"groove", "presses into a groove of 60 degrees, then against its sides", groove, judge_last},
      {"edge", "slides off the edge of a box and rests beside it", [](PersonScenario& s) { edge(s, 1.0); },
       judge_edge},
      {"edge-finely", "slides off the edge of a box at a scale of 0.2",
       [](PersonScenario& s) { edge(s, 0.2); }, judge_edge},
  };
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace longreach
