// A hand at rest when a wall is reported late: the force is limited by the energy store E to F = sqrt(2 E /
// (1/k + 1/k_hand)), because the energy for the motion of the hand must also come from the store.

#include <algorithm>
#include <cmath>

#include "deploy/lab/person/person_scenes.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {
namespace {

constexpr double kWall_m = 0.03, kFarWall_m = 0.05;
constexpr double kQuiet_n = 0.2;  // range of a settled force
constexpr double kShare = 0.2;    // of what is due, by which less may be felt

/// What is rendered of the wall's stiffness.
double rendered(const PersonScenario& s, double wall_n_per_m) {
  return std::min(wall_n_per_m, s.master.rendering.stiffness_max_n_per_m);
}

/// `more`: other springs against the hand, N/m.
double store_pays_n(const PersonScenario& s, double k, double more = 0.0) {
  const double hand = hand_model(s.grip).stiffness_n_per_m + more;
  return std::sqrt(2.0 * s.master.rendering.store_j / (1.0 / k + 1.0 / hand));
}

/// In position mode; `depth_m` of the hand behind the surface.
PersonChecks felt_by_depth(const PersonScenario& s, const MoveSeen& m, double k, double depth_m) {
  const double due_n = std::min({k * depth_m, s.master.rendering.force_max_n, store_pays_n(s, k)});
  return {{"shortfall of the hand force below the required force, N", (1.0 - kShare) * due_n - m.felt_n, 0.0},
          {"excess of the hand force over the wall force, N", m.felt_n - 1.1 * k * depth_m, 0.05},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kQuiet_n}};
}

double behind_wall_m(const PersonScenario& s, const MoveSeen& m) {
  return m.hand_m.x() - kWall_m / s.master.mapping.scale;
}

// Moves and waits, as people do over a link to the Moon.
void move_and_wait(PersonScenario& s) {
  only_wall(s, kWall_m, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0485, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 4.0, .wait_rtt = 2.0}};
}
PersonChecks judge_move_and_wait(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[0];
  PersonChecks all = felt_by_depth(s, m, 1000.0, behind_wall_m(s, m));
  all.push_back({"shortfall of the hand force below 1 N, N", 1.0 - m.felt_n, 0.0});
  return all;
}

// A hand that rests after a touch feels what the tool presses.
void touch_and_rest(PersonScenario& s, double wall_n_per_m, double depth_m, double m_per_s) {
  only_wall(s, kWall_m, wall_n_per_m);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {kWall_m / s.master.mapping.scale + depth_m, 0, 0},
              .speed_m_per_s = m_per_s,
              .wait_s = 4.0,
              .wait_rtt = 2.0}};
}
PersonChecks judge_touch_and_rest(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[0];
  const double due_n = m.tool_n / s.master.mapping.scale;
  return {{"difference between the hand force and the tool force, N", std::abs(m.felt_n - due_n),
           kShare * due_n + 0.02},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kQuiet_n}};
}
PersonChecks judge_deep_touch(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all = judge_touch_and_rest(s, seen);
  all.push_back({"shortfall of the hand force below 1 N, N", 1.0 - seen.move[0].felt_n, 0.0});
  return all;
}

// A smaller scale in contact: the hand's force stays, and the tool presses less.
void scaled_at_rest(PersonScenario& s) {
  only_wall(s, kWall_m, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.05, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.05, 0, 0}, .wait_s = 2.0, .wait_rtt = 2.0, .scale = 0.3}};
}
PersonChecks judge_scaled_at_rest(const PersonScenario&, const PersonSeen& seen) {
  const MoveSeen &before = seen.move[0], &after = seen.move[1];
  const double due_n = after.tool_n / 0.3;
  return {{"difference between the hand force and the tool force, N", std::abs(after.felt_n - due_n),
           kShare * due_n},
          {"loss of force at the hand, N", before.felt_n - after.felt_n, 0.1 * before.felt_n},
          {"maximum rise of the force in one tick, N", after.felt_step_n, 0.3}};
}

// A wall approaches while the hand rests. It moves on, so the force of one delay ago is felt.
constexpr double kComes_m_per_s = 3e-4;
void wall_that_comes(PersonScenario& s) {
  only_wall(s, 0.002 + kComes_m_per_s * (8.0 + 4.0 * s.rtt_s), 1000.0);
  s.slave.scene.surface[0].movement = MovementConfig{.velocity_m_per_s = {-kComes_m_per_s, 0.0, 0.0}};
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0, 0, 0}, .wait_s = 32.0, .wait_rtt = 4.0}};
}
PersonChecks judge_wall_that_comes(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[0];
  const double scale = s.master.mapping.scale, due_n = m.tool_n / scale;
  const double meanwhile_n = 1000.0 * kComes_m_per_s * (s.rtt_s + 0.3) / scale;
  return {{"difference between the hand force and the tool force, N", std::abs(m.felt_n - due_n),
           kShare * due_n + meanwhile_n},
          {"shortfall of the hand force below 0.8 N, N", 0.8 - m.felt_n, 0.0},
          {"distance between tool and goal, m", m.lead_max_m, kMostLead_m}};
}

// A retreat that stops inside the wall.
void stop_inside(PersonScenario& s) {
  only_wall(s, kWall_m, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.05, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.041, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 4.0, .wait_rtt = 2.0}};
}
PersonChecks judge_stop_inside(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[1];
  const double depth_m = behind_wall_m(s, m);
  return {{"excess of the hand force over the wall force, N",
           m.felt_n - 1.1 * 1000.0 * std::max(0.0, depth_m), 0.05},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kQuiet_n},
          in_front(seen)};
}

// Hold and engage again in contact: the wall stays where it is.
void hold_and_engage(PersonScenario& s) {
  only_wall(s, kWall_m, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0425, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.0425, 0, 0}, .wait_s = 1.0, .wait_rtt = 2.0, .hold = true},
             {.to_m = {0.0425, 0, 0}, .wait_s = 4.0, .wait_rtt = 4.0, .engage = true}};
}
PersonChecks judge_hold_and_engage(const PersonScenario&, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[2];
  return {
      {"the second engagement failed", m.engaged ? 0.0 : 1.0, 0.0},
      {"difference between the hand and tool forces, N", std::abs(m.felt_n - m.tool_n), 0.3 + 0.1 * m.tool_n},
      {"shortfall of the hand force below 0.2 N, N", 0.2 - m.felt_n, 0.0},
      {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kQuiet_n}};
}

// Rate mode, the handle held out against a wall.
void held_out(PersonScenario& s, double by_m, double wall_n_per_m, double wait_s = 10.0) {
  only_wall(s, kFarWall_m, wall_n_per_m);
  in_mode(s, MotionMode::kRate);
  // With a small deflection the tool moves slowly, so the wall is nearer.
  if (by_m < 0.02) only_wall(s, 0.01, wall_n_per_m);
  s.moves = {{.to_m = {by_m, 0, 0}, .wait_s = wait_s, .wait_rtt = 3.0}};
}
PersonChecks judge_held_out(const PersonScenario& s, const PersonSeen& seen) {
  const MoveSeen& m = seen.move[0];
  const double due_n = s.master.rendering.rate_force_ratio * m.tool_n;
  const double low = 0.98 * rendered(s, s.slave.scene.material[0].stiffness_n_per_m);  // found 2 % too low
  const double paid_n = store_pays_n(s, low, s.master.rendering.rate_stiffness_n_per_m);
  return {{"shortfall of the hand force below the required force, N",
           (1.0 - kShare) * std::min(commanded_n(s, m.hand_m.x()), paid_n) - m.felt_n, 0.0},
          {"difference between the hand force and its ratio of the tool force, N", std::abs(m.felt_n - due_n),
           kShare * due_n + 0.02},
          {"displacement of the handle past its home position, m", -m.hand_m.x(), 1e-4},
          {"peak-to-peak variation of the hand force, N", m.felt_swing_n, kQuiet_n}};
}
/// Held out far enough for a hand to bear what the guard permits, or what the store pays for, if that is less.
PersonChecks judge_felt(const PersonScenario& s, const PersonSeen& seen) {
  PersonChecks all = judge_held_out(s, seen);
  all.push_back(
      {"shortfall of the displayed force below the required minimum, N", 1.6 - seen.move[0].felt_n, 0.0});
  return all;
}

// The handle is released while the tool presses: the force decreases to that of a hold.
void let_go_pressing(PersonScenario& s) {
  held_out(s, 0.02, 1000.0, 12.0);
  s.slave.command.hold_force_n = 1.0;
  s.moves.push_back({.to_m = {0.02, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.5, .let_go = true});
  s.moves.push_back({.to_m = {0.02, 0, 0}, .wait_s = 2.0, .wait_rtt = 0.0, .let_go = true});
}
PersonChecks judge_let_go_pressing(const PersonScenario& s, const PersonSeen& seen) {
  return {{"the tool never pressed hard enough",
           seen.move[0].tool_max_n > hold_limit_n(s.slave.command) ? 0.0 : 1.0, 0.0},
          {"force at the tool, N", seen.move[2].tool_max_n, 1.05 * hold_limit_n(s.slave.command) + 0.1}};
}
// The handle is held at home: the tool keeps touching, and the goal does not move.
void held_at_home(PersonScenario& s) {
  held_out(s, 0.02, 1000.0, 12.0);
  s.moves.push_back({.to_m = {0.0, 0, 0}, .speed_m_per_s = 0.05, .wait_s = 1.0});
  s.moves.push_back({.to_m = {0.0, 0, 0}, .wait_s = 4.0});
}
PersonChecks judge_held_at_home(const PersonScenario& s, const PersonSeen& seen) {
  const double kept_n = 2.0 * configured_touch_n(s.slave.sensing);
  return {{"motion of the goal, m", (seen.move[2].goal_m - seen.move[1].goal_m).norm(), 1e-4},
          {"contact force on the hand, N", seen.move[2].felt_n, 0.05},
          {"force at the tool, N", seen.move[2].tool_n, 1.2 * kept_n}};
}

}  // namespace

void add_resting_hands(std::vector<PersonRow>& rows) {
  const std::vector<PersonRow> more = {
      {"move-and-wait", "moves the goal into a wall and waits", move_and_wait, judge_move_and_wait},
      {"touch-soft", "moves 30 mm into a wall of 200 N/m at 0.2 m/s and rests",
       [](PersonScenario& s) { touch_and_rest(s, 200.0, 0.03, 0.2); }, judge_deep_touch},
      {"touch-fast", "moves 30 mm into a wall of 1000 N/m at 0.2 m/s and rests",
       [](PersonScenario& s) { touch_and_rest(s, 1000.0, 0.03, 0.2); }, judge_deep_touch},
      {"touch-stiff", "moves 30 mm into a wall of 5000 N/m at 0.2 m/s and rests",
       [](PersonScenario& s) { touch_and_rest(s, 5000.0, 0.03, 0.2); }, judge_deep_touch},
      {"touch-lightly", "moves 5 mm into a wall of 200 N/m and rests",
       [](PersonScenario& s) { touch_and_rest(s, 200.0, 0.005, 0.05); }, judge_touch_and_rest},
      {"touch-briefly", "moves 3 mm into a wall of 400 N/m and rests",
       [](PersonScenario& s) { touch_and_rest(s, 400.0, 0.003, 0.05); }, judge_touch_and_rest},
      {"scale-at-rest", "reduces the scale from 0.8 to 0.3 while pressing", scaled_at_rest,
       judge_scaled_at_rest},
      {"wall-approaches", "rests while a wall of 1000 N/m approaches at 0.3 mm/s", wall_that_comes,
       judge_wall_that_comes},
      {"stop-inside", "retreats, but stops inside the wall", stop_inside, judge_stop_inside},
      {"hold-engage", "engages again after a hold while in contact", hold_and_engage, judge_hold_and_engage},
      {"held-out-slightly", "holds the handle deflected by 10 mm in rate mode",
       [](PersonScenario& s) { held_out(s, 0.01, 1000.0); }, judge_held_out},
      {"held-out-20", "holds the handle deflected by 20 mm in rate mode",
       [](PersonScenario& s) { held_out(s, 0.02, 1000.0); }, judge_held_out},
      {"held-out-soft", "holds the handle deflected by 45 mm against a wall of 500 N/m in rate mode",
       [](PersonScenario& s) { held_out(s, 0.045, 500.0); }, judge_felt},
      {"held-out-45", "holds the handle deflected by 45 mm against a wall of 1000 N/m in rate mode",
       [](PersonScenario& s) { held_out(s, 0.045, 1000.0); }, judge_felt},
      {"held-out-stiff", "holds the handle deflected by 45 mm against a wall of 7000 N/m in rate mode",
       [](PersonScenario& s) { held_out(s, 0.045, 7000.0); }, judge_felt},
      {"held-out-long", "holds the handle deflected by 45 mm in rate mode for a minute",
       [](PersonScenario& s) { held_out(s, 0.045, 3000.0, 60.0); }, judge_felt},
      {"let-go-pressing", "releases the deflected handle while the tool presses on a wall", let_go_pressing,
       judge_let_go_pressing},
      {"held-at-home", "returns the handle to its home position and holds it there", held_at_home,
       judge_held_at_home},
  };
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace longreach
