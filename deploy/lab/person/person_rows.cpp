#include "deploy/lab/person/person_rows.hpp"

#include <algorithm>

#include "deploy/lab/person/person_scenes.hpp"

namespace longreach {
namespace {

// F1: rate mode, the handle held out, a wall in the way, and back.
void hold_out(PersonScenario& s) {
  only_wall(s, 0.05, 1000.0);
  in_mode(s, MotionMode::kRate);
  s.moves = {{.to_m = {0.02, 0, 0}, .wait_s = 8.0, .wait_rtt = 3.0},
             {.to_m = {-0.02, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 4.0, .wait_rtt = 1.0}};
}
PersonChecks judge_hold_out(const PersonScenario& s, const PersonSeen& seen) {
  return {lead_before(s, seen, 0), lead_after(seen, 0), answers(s, seen.move[1]), in_front(seen)};
}

// F1, sideways: pressing on the face of a block, then off its edge.
void off_the_edge(PersonScenario& s) {
  only_box(s, {0.155, 0, 0}, {0.1, 0.08, 0.4}, 1000.0);  // wider than what the guard lets the tool press in
  in_mode(s, MotionMode::kRate);
  s.moves = {{.to_m = {0.025, 0, 0}, .wait_s = 12.0, .wait_rtt = 4.0},
             {.to_m = {0.0, 0.025, 0}, .speed_m_per_s = 0.1, .wait_s = 6.0, .wait_rtt = 2.0}};
  s.depth_m = [](const Vector3&) { return 1.0; };
}
PersonChecks judge_off_the_edge(const PersonScenario& s, const PersonSeen& seen) {
  // On its way off, and after it, along the normal of the face that it left.
  const double leap_m = seen.move[1].tool_most_m.x() - seen.move[0].tool_m.x();
  return {lead_before(s, seen, 0),
          lead_after(seen, 0),
          {"jump of the tool along the normal of the face, m", leap_m, kMostLead_m}};
}

// K: pushes on at the edge of the workspace, then back.
void workspace_rate(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kRate);
  s.slave.command.workspace_m = 0.1;
  s.moves = {{.to_m = {0.03, 0, 0}, .wait_s = 8.0, .wait_rtt = 3.0},
             {.to_m = {-0.02, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 3.0, .wait_rtt = 1.0}};
}
PersonChecks judge_workspace_rate(const PersonScenario& s, const PersonSeen& seen) {
  return {lead_before(s, seen, 0), lead_after(seen, 0), answers(s, seen.move[1])};
}

// K in position mode, with the clutch: strokes beyond the edge, and a short one back.
void workspace_strokes(PersonScenario& s) {
  clear(s);
  in_mode(s, MotionMode::kPosition);
  s.slave.command.workspace_m = 0.1;
  for (int stroke = 0; stroke < 5; ++stroke) {
    s.moves.push_back({.to_m = {0.03, 0, 0}, .wait_s = 1.0, .wait_rtt = 2.0});
    s.moves.push_back(
        {.to_m = {-0.03, 0, 0}, .speed_m_per_s = 0.1, .wait_s = 0.5, .wait_rtt = 0.0, .clutch = true});
  }
  s.moves.push_back({.to_m = {-0.03, 0, 0}, .wait_s = 1.0, .wait_rtt = 3.0});
  s.moves.push_back({.to_m = {-0.05, 0, 0}, .wait_s = 1.0, .wait_rtt = 1.0});
}
PersonChecks judge_workspace_strokes(const PersonScenario& s, const PersonSeen& seen) {
  const std::size_t last = seen.move.size() - 1;
  return {lead_after(seen, last - 1), answers(s, seen.move[last])};
}

// F: rate mode again after one touch of a stiff wall, 19 mm away from it.
void near_a_known_wall(PersonScenario& s) {
  only_wall(s, 0.03, 5000.0);
  in_mode(s, MotionMode::kPosition);
  s.master.mapping.rate_centre = RateCentre::kWhereModeBegan;
  s.moves = {{.to_m = {0.0395, 0, 0}, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.0136, 0, 0}, .wait_s = 1.0, .wait_rtt = 1.0},
             {.to_m = {0.0136, 0, 0}, .wait_s = 1.0, .wait_rtt = 1.0, .mode = MotionMode::kRate},
             {.to_m = {0.0265, 0, 0}, .wait_s = 0.6, .wait_rtt = 0.0},
             {.to_m = {0.0, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0}};
}
PersonChecks judge_near_a_known_wall(const PersonScenario&, const PersonSeen& seen) {
  const double forward_m = seen.move[3].goal_m.x() - seen.move[2].goal_m.x();
  return {in_front(seen), {"shortfall of the goal motion below 1 mm, m", 1e-3 - forward_m, 0.0}};
}

// J: touches a narrow box, passes beside it.
void beside_a_box(PersonScenario& s) {
  only_box(s, {0.05, 0, 0}, {0.04, 0.02, 0.04}, 5000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0395, 0, 0}, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.02, 0, 0}, .wait_s = 1.0, .wait_rtt = 1.0},
             {.to_m = {0.02, 0.035, 0}, .wait_s = 1.0, .wait_rtt = 1.0},
             {.to_m = {0.052, 0.035, 0}, .speed_m_per_s = 0.01, .wait_s = 1.0, .wait_rtt = 1.0},
             {.to_m = {0.052, 0.035, 0}, .wait_s = 1.0, .wait_rtt = 0.0}};
}
PersonChecks judge_gone(const PersonScenario&, const PersonSeen& seen) {
  return {{"contact force next to the box, N", seen.move.back().felt_max_n, kNothing_n}};
}

// J, two faces 3 mm apart: from the near one to where the far one is not reached yet.
void two_faces(PersonScenario& s) {
  only_box(s, {0.08, -0.05, 0}, {0.1, 0.1, 0.2}, 1000.0);
  SurfaceConfig far = s.slave.scene.surface[0];
  far.name = "far";
  far.box->centre_m = {0.083, 0.05, 0};
  s.slave.scene.surface.push_back(far);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.0, -0.02, 0}, .wait_s = 1.0},
             {.to_m = {0.040, -0.02, 0}, .wait_s = 3.0, .wait_rtt = 2.0},
             {.to_m = {0.025, -0.02, 0}, .wait_s = 1.0},
             {.to_m = {0.025, 0.02, 0}, .wait_s = 1.0},
             {.to_m = {0.0402, 0.02, 0}, .speed_m_per_s = 0.01, .wait_s = 0.5, .wait_rtt = 1.0},
             {.to_m = {0.0402, 0.02, 0}, .wait_s = 1.0, .wait_rtt = 0.0}};
}

// Less deep than twice the touch threshold nothing proves that the nearer face is not there.
PersonChecks judge_two_faces(const PersonScenario& s, const PersonSeen& seen) {
  return {{"contact force in front of the farther face, N", seen.move.back().felt_max_n,
           1.1 * 2.0 * configured_touch_n(s.slave.sensing) / s.master.mapping.scale}};
}

// L: the clutch in contact; then the hand presses again.
void clutch_in_contact(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.046, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.046, 0, 0}, .wait_s = 0.3, .wait_rtt = 0.0, .clutch = true},
             {.to_m = {0.030, 0, 0}, .wait_s = 0.3, .wait_rtt = 0.0, .clutch = true},
             {.to_m = {0.050, 0, 0}, .wait_s = 0.3, .wait_rtt = 0.0, .clutch = true},
             {.to_m = {0.030, 0, 0}, .wait_s = 0.5, .wait_rtt = 0.0, .clutch = true}};
}
PersonChecks judge_clutch_in_contact(const PersonScenario&, const PersonSeen& seen) {
  double clutched_n = 0.0;
  for (std::size_t i = 2; i < seen.move.size(); ++i)
    clutched_n = std::max(clutched_n, seen.move[i].felt_max_n);
  return {in_front(seen),
          {"contact force while clutched, N", clutched_n, kNothing_n},
          {"speed of the released hand, m/s", seen.move[1].hand_m_per_s, 0.1}};
}

// A hand that presses is freed by a stop.
void freed_by_stop(PersonScenario& s) {
  only_wall(s, 0.03, 1000.0);
  in_mode(s, MotionMode::kPosition);
  s.moves = {{.to_m = {0.046, 0, 0}, .speed_m_per_s = 0.01, .wait_s = 4.0, .wait_rtt = 2.0},
             {.to_m = {0.046, 0, 0}, .wait_s = 1.0, .wait_rtt = 0.0, .stop = true}};
}
PersonChecks judge_freed(const PersonScenario&, const PersonSeen& seen) {
  return {in_front(seen), {"speed of the released hand, m/s", seen.move[1].hand_m_per_s, 0.1}};
}

}  // namespace

const std::vector<PersonRow>& person_rows() {
  static const std::vector<PersonRow> kRows = [] {
    std::vector<PersonRow> all = {
        {"held-out", "holds the handle deflected against a wall in rate mode, then retreats", hold_out,
         judge_hold_out, true},
        {"off-the-edge", "presses on a block in rate mode, then moves sideways off its edge", off_the_edge,
         judge_off_the_edge, true},
        {"workspace",
         "pushes against the edge of the workspace in rate mode for a long time, then "
         "retreats",
         workspace_rate, judge_workspace_rate, true},
        {"strokes", "uses the clutch to move beyond the edge of the workspace in position mode, then returns",
         workspace_strokes, judge_workspace_strokes, true},
        {"near-a-known-wall", "approaches a stiff wall in rate mode after having touched it once",
         near_a_known_wall, judge_near_a_known_wall},
        {"beside-a-box", "touches a narrow box, then moves past it", beside_a_box, judge_gone, true},
        // Known: beside a face that it has left sideways, a light hand feels up to 0.26 N.
        {"two-faces", "touches the nearer of two faces, then moves in front of the farther one", two_faces,
         judge_two_faces},
        {"clutch", "holds the clutch while in contact and moves the hand back and forth", clutch_in_contact,
         judge_clutch_in_contact},
        {"stop", "stops the robot while the hand presses on a wall", freed_by_stop, judge_freed},
    };
    add_resting_hands(all);
    add_oriented_surfaces(all);
    add_shapes(all);
    add_rows_that_stay(all);
    return all;
  }();
  return kRows;
}

}  // namespace longreach
