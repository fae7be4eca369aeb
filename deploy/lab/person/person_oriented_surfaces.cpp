// Oriented surfaces: the displayed force at the second side of a slot, at a wall behind the tool, at a wall
// that was touched before the engagement, for nonlinear contact laws, and at stops. The required force is the
// true force at the tool, divided by the scale if the hand moves further than the tool.

#include <algorithm>
#include <cmath>

#include "deploy/lab/person/person_scenes.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {
namespace {

constexpr double kSide_m = 0.02;

/// As far as the store, or what the hand was not given of it before, pays for a wall that was learnt late,
/// and the limits let through.
double most_n(const PersonScenario& s, double k, double more = 0.0, double given_j = 0.0) {
  const double hand = hand_model(s.grip).stiffness_n_per_m + more;
  const double left_j = std::max(0.0, s.master.rendering.store_j - std::max(0.0, given_j));
  return std::min(s.master.rendering.force_max_n, std::sqrt(2.0 * left_j / (1.0 / k + 1.0 / hand)));
}

/// At the end of this move the displayed force must equal the force of the tool.
PersonChecks felt_as_pressed(const PersonScenario& s, const MoveSeen& m, double k, double least_n = 0.5) {
  const double due_n = m.tool_n / s.master.mapping.scale;
  const double most = most_n(s, k, 0.0, m.given_j);
  return {
      {"shortfall of the tool force below the required minimum, N", least_n - m.tool_n, 0.0},
      {"shortfall of the hand force below the required force, N",
       (1.0 - kTolerance) * std::min(due_n, most) - m.felt_n, kNoise_n},
      {"excess of the hand force over the tool force, N", m.felt_n - (1.0 + kTolerance) * due_n, kNoise_n},
      {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kSteady_n}};
}

void add(PersonChecks& all, PersonChecks more) { all.insert(all.end(), more.begin(), more.end()); }

// A slot: touches one side, then the other, then the first again.
void slot(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kPosition);
  add_wall(s, kSide_m, 1000.0);
  add_wall(s, -kSide_m, 1000.0, Vector3::UnitX());
  s.depth_m = [](const Vector3& p) { return std::abs(p.x()) - kSide_m; };
  for (const double to_m : {0.036, -0.036, 0.036})
    s.moves.push_back({.to_m = {to_m, 0, 0}, .wait_s = 5.0, .wait_rtt = 2.0});
}
PersonChecks judge_slot(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all{in_front(seen)};
  for (const MoveSeen& m : seen.move) add(all, felt_as_pressed(s, m, 1000.0));
  return all;
}
void slot_in_rate_mode(PersonScenario& s) {
  slot(s);
  in_mode(s, MotionMode::kRate);
  s.moves.clear();
  for (const double to_m : {0.03, -0.03})
    s.moves.push_back({.to_m = {to_m, 0, 0}, .wait_s = 15.0, .wait_rtt = 3.0});
}
/// In rate mode, the force at the hand is one ratio of the force at the tool, as far as the deflection commands it.
PersonChecks judge_rate(const PersonScenario& s, const MoveSeen& m, double k) {
  const double ratio = s.master.rendering.rate_force_ratio;
  const double paid_n = most_n(s, k, s.master.rendering.rate_stiffness_n_per_m, m.given_j);
  const double due_n = std::min(commanded_n(s, m.hand_m.norm()), paid_n);
  return {{"shortfall of the tool force below the required minimum, N", 0.5 - m.tool_n, 0.0},
          {"shortfall of the hand force below the required force, N", (1.0 - kTolerance) * due_n - m.felt_n,
           kNoise_n},
          {"difference between the hand force and its ratio of the tool force, N",
           std::abs(m.felt_n - ratio * m.tool_n), kTolerance * ratio * m.tool_n + 0.02},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kSteady_n}};
}
PersonChecks judge_slot_in_rate_mode(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all{in_front(seen)};
  for (const MoveSeen& m : seen.move) add(all, judge_rate(s, m, 1000.0));
  return all;
}

// A wall behind the start.
void behind(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kPosition);
  add_wall(s, -kSide_m, 1000.0, Vector3::UnitX());
  s.moves = {{.to_m = {-0.031, 0, 0}, .wait_s = 5.0, .wait_rtt = 2.0}};
}
PersonChecks judge_pressed(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all = felt_as_pressed(s, seen.move.back(), s.slave.scene.material[0].stiffness_n_per_m);
  all.push_back(in_front(seen));
  return all;
}

// A master that takes over from another one: it starts without any surface, with its handle at home.
void new_master(PersonScenario& s) {
  only_wall(s, 0.02, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.04, 0, 0}, .wait_s = 5.0, .wait_rtt = 2.0},
             {.to_m = {0.04, 0, 0}, .wait_s = 0.5, .stop = true},
             {.to_m = {0, 0, 0}, .wait_s = 1.0},
             {.to_m = {0, 0, 0}, .wait_s = 5.0, .wait_rtt = 4.0, .engage = true}};
}
PersonChecks judge_new_master(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[3];
  PersonChecks all = felt_as_pressed(s, m, 1000.0, 0.2);  // the handle was driven back from home
  all.push_back({"the engagement failed", m.engaged ? 0.0 : 1.0, 0.0});
  // Engaging takes a round trip itself, and the list comes with its answer.
  all.push_back({"time from the engagement until a force is displayed, s", m.felt_s < 0.0 ? 1e3 : m.felt_s,
                 2.0 * s.rtt_s + 1.5});
  return all;
}

// A slave that starts in contact: nothing is known of it until the tool has moved.
void started_in_contact(PersonScenario& s) {
  only_wall(s, -0.002, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.002, 0, 0}, .speed_m_per_s = 0.005, .wait_s = 5.0, .wait_rtt = 2.0}};
}

// Nonlinear contact laws, whose exponent is configured at the slave. Pressed slowly, then at rest.
void curved(PersonScenario& s, double exponent, double stiffness_n_per_m, MotionMode mode) {
  only_wall(s, 0.02, stiffness_n_per_m);
  s.slave.scene.material[0].exponent = exponent;
  s.slave.estimator.exponent = exponent;
  in_mode(s, mode);
  if (mode == MotionMode::kPosition) {
    s.moves = {{.to_m = {0.0275, 0, 0}, .wait_s = 2.0},
               {.to_m = {0.033, 0, 0}, .speed_m_per_s = 2e-3, .wait_s = 5.0, .wait_rtt = 6.0}};
  } else {
    s.moves = {{.to_m = {0.03, 0, 0}, .wait_s = 20.0, .wait_rtt = 3.0}};
  }
}
PersonChecks judge_curved(const PersonScenario& s, const PersonSeen& seen) {
  // The slope at 3 N.
  return felt_as_pressed(s, seen.move.back(), 1500.0);
}
PersonChecks judge_curved_rate(const PersonScenario& s, const PersonSeen& seen) {
  return judge_rate(s, seen.move.back(), 1500.0);
}

// Stops of a hinge: rendered softer by ke_rotation, which the device can bear.
void hinge(PersonScenario& s, MotionMode mode, double turn_rad, double first_s, double second_s) {
  clear(s);
  in_mode(s, mode);
  s.slave.sensing.moment = true;
  s.slave.scene.material[0].stiffness_n_per_m = 1000.0;
  s.master.rendering.ke_rotation = 0.02;
  for (const double side : {1.0, -1.0}) {
    SurfaceConfig stop;
    stop.name = side > 0.0 ? "left" : "right";
    stop.material = s.slave.scene.material[0].name;
    stop.hinge = HingeConfig{.axis = {0.0, 0.0, side}, .angle_rad = 0.05, .arm_m = 0.1};
    s.slave.scene.surface.push_back(stop);
  }
  s.depth_m = [](const Vector3&) { return 0.0; };
  s.moves = {{.wait_s = first_s, .wait_rtt = 2.0, .turn_rad = {0.0, 0.0, turn_rad}},
             {.wait_s = second_s, .wait_rtt = 5.0, .turn_rad = {0.0, 0.0, -turn_rad}}};
}
PersonChecks judge_hinge(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all;
  const RenderingConfig& rendering = s.master.rendering;
  const bool position = s.master.mapping.mode == MotionMode::kPosition;
  const double ratio = position ? rendering.ke_rotation / s.master.mapping.scale : rendering.rate_force_ratio;
  for (const MoveSeen& m : seen.move) {
    const double due_nm = std::min(ratio * m.tool_nm, rendering.moment_max_nm);
    add(all, {{"shortfall of the tool moment below the required minimum, N m", 0.05 - m.tool_nm, 0.0},
              {"shortfall of the hand moment below the required moment, N m",
               (1.0 - kTolerance) * due_nm - m.felt_nm, 1e-3},
              {"excess of the hand moment over the tool moment, N m",
               m.felt_nm - (1.0 + kTolerance) * ratio * m.tool_nm, 1e-3}});
  }
  return all;
}

}  // namespace

void add_oriented_surfaces(std::vector<PersonRow>& rows) {
  constexpr MotionMode kPosition = MotionMode::kPosition, kRate = MotionMode::kRate;
  const std::vector<PersonRow> more = {
      {"slot", "presses on both sides of a slot", slot, judge_slot},
      {"slot-rate", "presses on both sides of a slot in rate mode", slot_in_rate_mode,
       judge_slot_in_rate_mode},
      {"behind", "touches and presses on a wall behind the start", behind, judge_pressed},
      {"new-master", "engages where another master left the tool in contact", new_master, judge_new_master},
      {"starts-in-contact", "starts with the tool already in contact", started_in_contact, judge_pressed},
      {"curved-1.5", "presses on a material with exponent 1.5",
       [](PersonScenario& s) { curved(s, 1.5, 600.0, kPosition); }, judge_curved},
      {"curved-2", "presses on a material with exponent 2",
       [](PersonScenario& s) { curved(s, 2.0, 300.0, kPosition); }, judge_curved},
      {"curved-2-rate", "presses on a material with exponent 2 in rate mode",
       [](PersonScenario& s) { curved(s, 2.0, 300.0, kRate); }, judge_curved_rate},
      {"hinge", "turns a hinge against both of its stops",
       [](PersonScenario& s) { hinge(s, kPosition, 0.12, 5.0, 5.0); }, judge_hinge},
      {"hinge-rate", "turns a hinge against both of its stops in rate mode",
       [](PersonScenario& s) { hinge(s, kRate, 0.25, 8.0, 16.0); }, judge_hinge},
  };
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace longreach
