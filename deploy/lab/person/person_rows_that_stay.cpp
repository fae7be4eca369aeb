// Behaviour that was already handled correctly before this experiment was written. Two pages and a closing
// tab require the real programs (tests/process, View).

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deploy/lab/contact/drag.hpp"
#include "deploy/lab/person/person_scenes.hpp"

namespace longreach {
namespace {

constexpr double kHome_m = 1.1e-3;  // where the friction of the device leaves it
constexpr double kNormal_rad =
    std::numbers::pi / 90.0;  // of a surface whose normal noise at the touch has turned

/// Of the tool, in all moves.
PersonCheck stable(const PersonSeen& seen) {
  double most = 0.0;
  for (const MoveSeen& m : seen.move) most = std::max(most, m.tool_m_per_s2);
  return {"acceleration of the tool, m/s^2", most, 1.5};
}

// A surface that is really pressed lightly for a minute stays, and the
// second touch is felt.
void light_press(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.0377, 0, 0}, .wait_s = 20.0, .wait_rtt = 2.0},
             {.to_m = {0.020, 0, 0}, .wait_s = 1.0, .wait_rtt = 1.0},
             {.to_m = {0.055, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 0.0, .wait_rtt = 0.0}};
}
PersonChecks judge_light_press(const PersonScenario&, const PersonSeen& seen) {
  return {in_front(seen),
          {"shortfall of the force at the second touch below 1 N, N", 1.0 - seen.move[3].felt_max_n, 0.0}};
}

// Releasing the handle in contact: the tool stays at the last goal.
void let_go_in_contact(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.041, 0, 0}, .wait_s = 0.5, .wait_rtt = 0.5, .let_go = true},
             {.to_m = {0.041, 0, 0}, .wait_s = 4.0, .let_go = true}};
}
PersonChecks judge_let_go(const PersonScenario&, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[2];
  return {{"displacement of the tool, m", m.tool_span_m(), 1e-4},
          {"distance of the handle from its home position, m", m.hand_m.norm(), kHome_m}};
}
void let_go_in_rate_mode(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kRate);
  s.moves = {{.to_m = {0.016, 0, 0}, .wait_s = 12.0, .wait_rtt = 3.0},
             {.to_m = {0.016, 0, 0}, .wait_s = 2.0, .wait_rtt = 0.5, .let_go = true},
             {.to_m = {0.016, 0, 0}, .wait_s = 4.0, .let_go = true}};
}

// The mode is switched in contact and while deflected: no step of the goal.
void mode_switched(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.041, 0, 0}, .wait_s = 1.0, .mode = MotionMode::kRate},
             {.to_m = {0.020, 0, 0}, .wait_s = 0.5, .wait_rtt = 0.0},
             {.to_m = {0.020, 0, 0}, .wait_s = 1.0, .mode = MotionMode::kPosition}};
}
PersonChecks judge_mode_switched(const PersonScenario&, const PersonSeen& seen) {
  double step_m = 0.0;
  for (const MoveSeen& m : seen.move) step_m = std::max(step_m, m.goal_step_m);
  return {in_front(seen), {"maximum jump of the goal in one tick, m", step_m, 2.5e-4}};
}

// The scale is changed in contact: the goal moves out of the wall no faster than the mapping permits, and the force does not
// step.
void scale_in_contact(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0}};
  for (const double scale : {0.5, 0.05, 0.8})
    s.moves.push_back({.to_m = {0.041, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0, .scale = scale});
}
PersonChecks judge_scale(const PersonScenario&, const PersonSeen& seen) {
  double step_m = 0.0, rise_n = 0.0;
  for (std::size_t i = 1; i < seen.move.size(); ++i) {
    step_m = std::max(step_m, seen.move[i].goal_step_m);
    rise_n = std::max(rise_n, seen.move[i].felt_step_n);
  }
  return {{"maximum jump of the goal in one tick, m", step_m, 2.5e-4 + 1e-9},
          {"maximum rise of the force in one tick, N", rise_n, 0.1}};
}

// A wall behind the start; leaving after a long press.
void behind_and_back(PersonScenario& s) {
  clear(s);
  add_wall(s, -0.02, 1000.0, Vector3::UnitX());
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {-0.029, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 10.0, .wait_rtt = 2.0},
             {.to_m = {0.0, 0, 0}, .wait_s = 2.0, .wait_rtt = 1.0}};
}
PersonChecks judge_behind(const PersonScenario& s, const PersonSeen& seen) {
  return {in_front(seen),
          answers(s, seen.move[1]),
          {"force at the hand after the retreat, N", seen.move[1].felt_n, 0.0}};
}

// Stop and engage again in contact: the tool does not jump.
void stop_and_engage(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.041, 0, 0}, .wait_s = 2.0, .wait_rtt = 2.0, .stop = true},
             {.to_m = {0.041, 0, 0}, .wait_s = 2.0, .wait_rtt = 3.0, .engage = true}};
}
PersonChecks judge_stop_and_engage(const PersonScenario&, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[2];
  return {stable(seen),
          {"increase in the force at the tool, N", m.tool_max_n - seen.move[1].tool_n, 0.3},
          {"the second engagement failed", m.engaged ? 0.0 : 1.0, 0.0}};
}

// The clutch while the hand moves: the goal stays where it was.
void clutch_in_motion(PersonScenario& s, MotionMode mode) {
  clear(s);
  in_mode(s, mode);
  s.moves = {{.to_m = {0.03, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 0.0, .wait_rtt = 0.0},
             {.to_m = {0.04, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 0.5, .clutch = true},
             {.to_m = {-0.02, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 0.5, .clutch = true},
             {.to_m = {-0.02, 0, 0}, .wait_s = 1.0}};
}
PersonChecks judge_clutch_in_motion(const PersonScenario&, const PersonSeen& seen) {
  const double way_m = (seen.move[2].goal_m - seen.move[0].goal_m).norm();
  return {{"displacement of the goal while clutched, m", way_m, 1e-3}, stable(seen)};
}

// A stop at speed; limits, scale and mode that are changed in motion.
void stop_at_speed(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.04, 0, 0}, .speed_m_per_s = 0.15, .wait_s = 0.0, .wait_rtt = 0.0},
             {.to_m = {0.045, 0, 0}, .speed_m_per_s = 0.15, .wait_s = 2.0, .stop = true}};
}
PersonChecks judge_stop_at_speed(const PersonScenario&, const PersonSeen& seen) {
  return {stable(seen), {"the robot is still engaged", seen.move[1].engaged ? 1.0 : 0.0, 0.0}};
}
void set_in_motion(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kRate);
  const Vector3 out(0.02, 0.0, 0.0);
  s.moves = {
      {.to_m = out, .wait_s = 1.0, .wait_rtt = 0.5},
      {.to_m = out, .wait_s = 1.0, .change = [](MasterConfig& c) { c.mapping.kv_per_s *= 0.2; }},
      {.to_m = out, .wait_s = 1.0, .change = [](MasterConfig& c) { c.mapping.kv_per_s *= 5.0; }},
      {.to_m = out, .wait_s = 1.0, .change = [](MasterConfig& c) { c.mapping.speed_max_m_per_s *= 0.1; }},
      {.to_m = out, .wait_s = 1.0, .mode = MotionMode::kPosition},
      {.to_m = out, .wait_s = 1.0, .scale = 0.2},
      {.to_m = {-0.02, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 0.0, .wait_rtt = 0.0},
      {.to_m = {-0.02, 0, 0}, .wait_s = 1.0, .mode = MotionMode::kRate}};
}
PersonChecks judge_set_in_motion(const PersonScenario&, const PersonSeen& seen) { return {stable(seen)}; }

// What is felt has the direction of the surface: pressed, then slid along, then pressed more.
PersonChecks judge_direction(const PersonSeen& seen, const Vector3& out) {
  const MoveSeen& m = seen.move.back();
  const double angle = std::atan2(m.felt.cross(out).norm(), m.felt.dot(out));
  return {in_front(seen),
          {"shortfall of the hand force below 0.5 N, N", 0.5 - m.felt_n, 0.0},
          {"angle between force and surface normal, rad", angle, kNormal_rad}};
}
void oblique(PersonScenario& s) {
  clear(s);
  add_wall(s, 0.03, 1000.0, Vector3(-1.0, 1.0, 0.0));
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.055, 0.014, 0}, .speed_m_per_s = 0.01, .wait_s = 1.0},
             {.to_m = {0.060, 0.009, 0}, .speed_m_per_s = 0.01, .wait_s = 1.0}};
}
PersonChecks judge_oblique(const PersonScenario&, const PersonSeen& seen) {
  return judge_direction(seen, Vector3(-1.0, 1.0, 0.0).normalized());
}
void turned_base(PersonScenario& s, double angle_rad) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.master.mapping.base_rotation_rad = {0.0, 0.0, angle_rad};
  const Vector3 inward = exp_rotation(-s.master.mapping.base_rotation_rad) * Vector3::UnitX();
  s.moves = {{.to_m = 0.041 * inward, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = 0.046 * inward, .speed_m_per_s = 0.01, .wait_s = 1.0}};
}
PersonChecks judge_turned_base(const PersonScenario& s, const PersonSeen& seen) {
  return judge_direction(seen, exp_rotation(-s.master.mapping.base_rotation_rad) * -Vector3::UnitX());
}

// A sponge and a block of steel.
void soft_wall(PersonScenario& s) {
  only_wall(s, 0.02, 50.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.05, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.06, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 1.0}};
}
PersonChecks judge_soft_wall(const PersonScenario& s, const PersonSeen& seen) {
  const double depth_m = seen.move.back().goal_m.x() - 0.02;
  return {in_front(seen),
          {"excess of the hand force over the wall force, N",
           seen.move.back().felt_n - 50.0 * depth_m / s.master.mapping.scale, 0.1}};
}
void hard_wall(PersonScenario& s) {
  only_wall(s, 0.03, 1e6);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0378, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.0400, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 1.0}};
}
PersonChecks judge_hard_wall(const PersonScenario&, const PersonSeen& seen) {
  return {in_front(seen), {"the stiffness limit was not reported", seen.move.back().cut ? 0.0 : 1.0, 0.0}};
}

// Through a thin sheet, then against its far side.
void thin_sheet(PersonScenario& s) {
  only_box(s, {0.031, 0, 0}, {0.002, 0.4, 0.4}, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.055, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.055, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0},
             {.to_m = {0.0393, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0}};
}
PersonChecks judge_thin_sheet(const PersonScenario&, const PersonSeen& seen) {
  return {{"force behind the sheet, N", seen.move[1].felt_max_n, kNothing_n},
          {"force that pulls the hand into the sheet, N", -seen.move[2].felt.x(), 0.05}};
}

// The link times out in contact, and while the tool is approaching a wall.
void blackout_in_contact(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.041, 0, 0}, .wait_s = 3.0, .wait_rtt = 2.0, .blackout_s = 0.7}};
}
PersonChecks judge_blackout_in_contact(const PersonScenario&, const PersonSeen& seen) {
  return {in_front(seen), stable(seen), {"displacement of the tool, m", seen.move[1].tool_span_m(), 1e-3}};
}
void blackout_at_a_touch(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {
      {.to_m = {0.035, 0, 0}, .speed_m_per_s = 0.01},
      {.to_m = {0.046, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 5.0, .wait_rtt = 2.0, .blackout_s = 3.0},
      {.to_m = {0.046, 0, 0}, .wait_s = 2.0, .wait_rtt = 3.0, .engage = true}};
}
PersonChecks judge_blackout_at_a_touch(const PersonScenario&, const PersonSeen& seen) {
  return {in_front(seen),
          stable(seen),
          {"increase in the force at the tool, N", seen.move[2].tool_max_n - seen.move[1].tool_n, 0.3},
          {"the second engagement failed", seen.move[2].engaged ? 0.0 : 1.0, 0.0}};
}

// A free-floating spacecraft is pushed and drifts away, after which no force is displayed.
void spacecraft(PersonScenario& s) {
  clear(s);
  s.slave.scene.material.resize(1);
  const std::string material = "hull";
  s.slave.scene.material[0].name = material;
  s.slave.scene.material[0].stiffness_n_per_m = 6000.0;
  BodiesConfig& bodies = s.slave.scene.bodies.emplace();
  bodies.mjcf_file = "push.xml";
  bodies.file = {{"push.xml", "<mujoco><option gravity='0 0 0'/><asset><material name='" + material +
                                  "'/></asset><worldbody>"
                                  "<body name='tool'><freejoint/><geom type='sphere' size='0.02' material='" +
                                  material +
                                  "'/></body>"
                                  "<body name='craft' pos='0.15 0 0'><freejoint/>"
                                  "<geom type='box' size='0.1 0.1 0.1' mass='28' material='" +
                                  material +
                                  "'/></body>"
                                  "</worldbody></mujoco>"}};
  s.depth_m = [](const Vector3&) { return 1.0; };
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.05, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.05, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0}};
}
PersonChecks judge_spacecraft(const PersonScenario& s, const PersonSeen& seen) {
  return {{"the tool never touched anything", seen.move[0].tool_max_n > 1.0 ? 0.0 : 1.0, 0.0},
          {"force at the tool, N", seen.move[0].tool_max_n, 1.35 * s.slave.command.force_guard_n},
          {"contact force from a body that has moved away, N", seen.move[1].felt_max_n, kNothing_n}};
}

// A load in the gripper increases the resistance once the slave has reported it and the hand moves.
void load(PersonScenario& s) {
  clear(s);
  s.slave.scene.material.push_back({"hard", 2e4, 0.001, 1.0, 0.5});
  s.slave.scene.bodies = bodies_of({.mass_kg = 2.0});
  in_mode(s, MotionMode::kRate);
  s.moves = {{.to_m = {0.015, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0},
             {.to_m = {0.0, 0, 0}, .wait_s = 1.5, .wait_rtt = 1.0, .load = true},
             {.to_m = {0.015, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0}};
}
PersonChecks judge_load(const PersonScenario&, const PersonSeen& seen) {
  return {{"resistance without the load, N", seen.move[0].hand_n, 0.9 * seen.move[2].hand_n}};
}

// A wall approaches and presses on the tool; a retreat ends the contact.
void coming_wall(PersonScenario& s) {
  clear(s);
  add_wall(s, 0.01, 1000.0);
  MovementConfig movement;
  movement.velocity_m_per_s.x() = -0.06 / (20.0 + 8.0 * s.rtt_s);
  s.slave.scene.surface[0].movement = movement;
  s.depth_m = [](const Vector3&) { return 1.0; };
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0, 0, 0}, .wait_s = 6.0, .wait_rtt = 0.5},
             {.to_m = {-0.06, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 1.0}};
}
PersonChecks judge_coming_wall(const PersonScenario& s, const PersonSeen& seen) {
  return {{"the tool never touched anything", seen.move[0].tool_max_n > 1.0 ? 0.0 : 1.0, 0.0},
          answers(s, seen.move[1]),
          {"force at the tool after the retreat, N", seen.move[1].tool_n, 0.0},
          {"force at the hand after the retreat, N", seen.move[1].felt_n, kNothing_n}};
}

}  // namespace

void add_rows_that_stay(std::vector<PersonRow>& rows) {
  constexpr double kEighth = std::numbers::pi / 4.0;
  const std::vector<PersonRow> more = {
      {"light-press", "presses lightly for 20 s, retreats, then touches again", light_press,
       judge_light_press},
      {"let-go", "releases the handle while in contact", let_go_in_contact, judge_let_go},
      {"let-go-rate", "releases the handle while in contact in rate mode", let_go_in_rate_mode, judge_let_go},
      {"mode", "switches the mode while in contact and while the handle is deflected", mode_switched,
       judge_mode_switched},
      {"scale", "changes the scale while in contact", scale_in_contact, judge_scale},
      {"clutch-moving", "holds the clutch while the hand moves",
       [](PersonScenario& s) { clutch_in_motion(s, MotionMode::kPosition); }, judge_clutch_in_motion},
      {"clutch-rate", "holds the clutch while the robot moves in rate mode",
       [](PersonScenario& s) { clutch_in_motion(s, MotionMode::kRate); }, judge_clutch_in_motion},
      {"stop-at-speed", "stops the robot while it moves", stop_at_speed, judge_stop_at_speed},
      {"set-in-motion", "changes limits, scale and mode while the robot moves", set_in_motion,
       judge_set_in_motion},
      {"oblique", "presses on an oblique wall and slides along it", oblique, judge_oblique},
      {"base-45", "presses on a wall with the base of the device rotated by 45 degrees",
       [](PersonScenario& s) { turned_base(s, kEighth); }, judge_turned_base},
      {"base-90", "presses on a wall with the base of the device rotated by 90 degrees",
       [](PersonScenario& s) { turned_base(s, 2.0 * kEighth); }, judge_turned_base},
      {"base-180", "presses on a wall with the base of the device rotated by 180 degrees",
       [](PersonScenario& s) { turned_base(s, 4.0 * kEighth); }, judge_turned_base},
      {"soft-wall", "presses on a wall of 50 N/m", soft_wall, judge_soft_wall},
      {"hard-wall", "presses on a wall of 1000 kN/m", hard_wall, judge_hard_wall},
      {"thin-sheet", "pushes through a thin sheet, then presses on its far side", thin_sheet,
       judge_thin_sheet},
      {"behind", "presses on a wall behind the start for a long time, then retreats", behind_and_back,
       judge_behind},
      {"blackout", "loses the link for 0.7 s while in contact", blackout_in_contact,
       judge_blackout_in_contact},
      {"blackout-touch", "loses the link for 3 s while the tool reaches a wall", blackout_at_a_touch,
       judge_blackout_at_a_touch},
      {"engage", "stops and engages again while in contact", stop_and_engage, judge_stop_and_engage},
      {"spacecraft", "pushes a free-floating spacecraft", spacecraft, judge_spacecraft},
      {"load", "closes the gripper on a load", load, judge_load},
      {"coming-wall", "retreats from an approaching wall", coming_wall, judge_coming_wall},
  };
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace longreach
