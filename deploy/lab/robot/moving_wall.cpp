// A wall approaches a robot that an operator holds still, for four arms. Measures the force while the robot
// retreats, and what is reported when the retreat budget is used up. The same with walls of three layers,
// each four times as stiff as the previous one, and with both kinds of walls while the hand moves back and
// forth until the robot holds. Finally the first walls, fixed and approaching, with a force sensor of the
// wrong sign. The evaluation uses the simulated plant (true force, position and speed); from the slave, only
// its reports are used.
//
// The bound on the force, with the stiffness k (of the deepest layer), the speed v of the wall, and the
// acceleration limit a of the tool:
//   while k v <= 250 N/s    1.35 G
//   else                    0.8 G + k (v t_d + v²/(2 a)), at least that;  t_d = 40 ms from force to tool
// v includes the speed of the hand. The bound does not apply to layers, which have their own metrics.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/robot/faulty_sensor.hpp"
#include "deploy/lab/trace.hpp"
#include "slave/config/guard_config.hpp"

namespace longreach {
namespace {

constexpr std::array<const char*, 4> kArms{"space_arm", "puma560", "ur10", "cartesian"};
constexpr std::array kSpeeds_m_per_s{1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.05};
constexpr std::array kStiffness_n_per_m{200.0, 600.0, 2e3, 6e3, 2e4};
constexpr double kTouched_s = 3.0;
constexpr double kLonger_s = 1.0, kLongest_s = 60.0;
constexpr double kGuard_n = 20.0, kGiveWay_m = 0.2;
/// For a fixed wall, because the hand can press a soft wall in by at most 50 mm.
constexpr double kSoftGuard_n = 10.0;
constexpr double kBraking_m = 4e-3;  // braking distance from 50 mm/s, including the lag of the servo
constexpr double kHand_m_per_s = 0.02, kWall_m = 2e-3;
constexpr double kHaste_n_per_s = 250.0, kReact_s = 0.04;
constexpr double kStopped = 0.1;  // fraction of the speed of the wall
constexpr std::array kLayeredSpeeds_m_per_s{3e-3, 0.01, 0.03};
constexpr std::array kLayered_n_per_m{2e3, 6e3, 2e4};
constexpr std::array kHands_m_per_s{5e-3, 0.02};
constexpr double kStiffer = 4.0;                       // stiffness ratio of successive layers
constexpr std::array kLayer_n{7.0, 17.5, 1e9};         // force up to which each layer is pressed
constexpr std::array kLayer{"skin", "flesh", "bone"};  // names in the scene
constexpr double kReach_m = 0.015;                     // amplitude of the back-and-forth motion of the hand

struct Cell {
  std::size_t arm = 0;
  double wall_n_per_m = 0.0;
  double wall_m_per_s = 0.0;  // 0: the wall is fixed, and the hand moves to it
  bool wrong_sign = false;
  double give_way_m = kGiveWay_m;
  bool layers = false;
  double hand_m_per_s = 0.0;
};

struct Outcome {
  double force_n = 0.0;  // true, largest while the way lasts
  double way_m = 0.0;    // away from the wall, largest; of a wrong sign towards it, from the first 0.8 G on
  bool used_up = false;
  std::optional<double> stopped_s{}, reported_s{};  // used up and at rest; the right words
  std::optional<double> sign_s{};                   // a fault of the sensor is told
  double sign_force_n = 0.0;                        // true, then
  std::optional<double> near_s{};                   // 0.8 G felt
  HoldCause held{};                                 // first reported hold cause
};

/// The cause that the operator must be shown: retreat towards -x.
bool right_words(const Reason& cause) {
  return cause == HoldCause::kSurfaceApproaching && cause.value == -1.0;
}

bool of_the_sensor(HoldCause cause) {
  return cause == HoldCause::kSensorFault || cause == HoldCause::kSensorSign;
}

/// For a sensor with the wrong sign, "force persists" is also correct.
bool stops_a_wrong_sign(HoldCause cause) {
  return of_the_sensor(cause) || cause == HoldCause::kForcePersists;
}

double guard_n(const Cell& c) {
  return c.wall_m_per_s == 0.0 && c.wall_n_per_m < 500.0 ? kSoftGuard_n : kGuard_n;
}

double watched_s(const Cell& c) {
  if (c.wall_m_per_s == 0.0) return kTouched_s + guard_n(c) / (c.wall_n_per_m * kHand_m_per_s) + 5.0;
  const double deep_m = (c.layers ? 16.0 : 2.0) * kGuard_n / c.wall_n_per_m;
  const double comes_s = (deep_m + 1.1 * kGiveWay_m) / c.wall_m_per_s;
  return kTouched_s + std::min(comes_s + kLonger_s, kLongest_s);
}

std::string numbered(const std::string& path, double value, const char* more = "") {
  return path + "=" + std::to_string(value) + more;
}

/// Sets the initial position and the velocity of a surface.
void place(std::vector<std::string>& all, const std::string& surface, double at_m, double m_per_s) {
  all.push_back(numbered("scene.surface." + surface + ".plane.point_m", at_m, ",0,0"));
  all.push_back(numbered("scene.surface." + surface + ".movement.velocity_m_per_s", -m_per_s, ",0,0"));
}

/// Adds layers whose stiffness increases to `wall_n_per_m` in steps at the forces kLayer_n.
void place_layers(std::vector<std::string>& all, const Cell& c, double from_m) {
  all.emplace_back("scene_file=scenes/layers.txtpb");
  double above_n_per_m = 0.0, above_n = 0.0, at_m = from_m;
  double k = c.wall_n_per_m / std::pow(kStiffer, static_cast<double>(kLayer.size() - 1));
  for (std::size_t i = 0; i < kLayer.size(); ++i) {
    place(all, kLayer[i], at_m, c.wall_m_per_s);
    all.push_back(
        numbered(std::string("scene.material.") + kLayer[i] + ".stiffness_n_per_m", k - above_n_per_m));
    at_m += (kLayer_n[i] - above_n) / k;
    above_n = kLayer_n[i];
    above_n_per_m = k;
    k *= kStiffer;
  }
}

proto::LabConfig wall_config(const Cell& c) {
  const double from_m = c.wall_m_per_s == 0.0 ? kWall_m : c.wall_m_per_s * kTouched_s;
  std::vector<std::string> all{"profile=lab",
                               std::string("robot_file=robots/") + kArms[c.arm] + ".txtpb",
                               "mapping.mode=POSITION",
                               "mapping.scale=1",
                               "safety.engage_at_start=true",
                               numbered("command.force_guard_n", guard_n(c)),
                               numbered("command.give_way_m", c.give_way_m)};
  if (c.layers) {
    place_layers(all, c, from_m);
  } else {
    place(all, "wall", from_m, c.wall_m_per_s);
    all.push_back(numbered("scene.material.wall.stiffness_n_per_m", c.wall_n_per_m));
  }
  return configure(all, find_deploy_folder());
}

/// The hand moves to a fixed wall. In front of an approaching wall it rests, or moves back and forth from the
/// touch on.
double hand_m(const Cell& c, double t_s) {
  const double since_s = std::max(t_s - kTouched_s, 0.0);
  if (c.wall_m_per_s == 0.0) return kHand_m_per_s * since_s;
  const double way_m = std::fmod(c.hand_m_per_s * since_s + kReach_m, 4.0 * kReach_m);
  return std::abs(way_m - 2.0 * kReach_m) - kReach_m;
}

Outcome met(const ExperimentRun& run, const Cell& c) {
  const proto::LabConfig config = wall_config(c);
  const SlaveConfig slave = to_struct(config.slave());
  Laboratory lab(to_struct(config.master()), slave, run.seed);
  FaultySensor sensor(slave.robot);
  if (c.wrong_sign) sensor.sensor_fault({SensorFaultKind::kSign});
  OnRobot hooks([&](Time now, RobotState& robot) { sensor.apply(now, robot); });
  lab.set_fault_hooks(hooks);
  Outcome out;
  const double from_m = lab.arm().start_pose().p.x(), until_s = watched_s(c);
  double near_m = 0.0;
  const auto ends = [&] { return out.sign_s || (c.hand_m_per_s > 0.0 && out.held != HoldCause::kNone); };
  while (lab.now_s() < until_s && !ends()) {
    const double t_s = lab.now_s();
    HandTarget hand;
    hand.position_m.x() = hand_m(c, t_s);
    lab.drive(hand);
    lab.step();
    const double force_n = lab.arm().true_wrench().force.norm(), x_m = lab.arm().true_pose().p.x();
    if (!out.near_s && force_n >= 0.8 * guard_n(c)) {
      out.near_s = lab.now_s();
      near_m = x_m;
    }
    out.way_m = std::max(out.way_m, !c.wrong_sign ? from_m - x_m : out.near_s ? x_m - near_m : 0.0);
    out.used_up = out.used_up || out.way_m >= kGiveWay_m - kBraking_m;
    if (!out.used_up) out.force_n = std::max(out.force_n, force_n);
    const bool rests = lab.arm().true_velocity().norm() < kStopped * c.wall_m_per_s;
    if (out.used_up && rests && !out.stopped_s) out.stopped_s = lab.now_s();
    if (!out.reported_s && right_words(lab.slave().cause)) out.reported_s = lab.now_s();
    const HoldCause cause = lab.slave().cause;
    if (out.held == HoldCause::kNone && lab.now_s() > kTouched_s) out.held = cause;
    if (c.wrong_sign ? stops_a_wrong_sign(cause) : of_the_sensor(cause)) {
      out.sign_s = lab.now_s();
      out.sign_force_n = force_n;
    }
  }
  return out;
}

/// Maximum speed of wall and hand.
double nears_m_per_s(const Cell& c) { return c.wall_m_per_s + c.hand_m_per_s; }

double bound_n(const Cell& c) {
  const double k = c.wall_n_per_m, v = nears_m_per_s(c);
  if (k * v <= kHaste_n_per_s) return kGuardOvershoot * kGuard_n;
  const double a = CommandConfig{}.acceleration_max_m_per_s2;
  return std::max(kGuardOvershoot * kGuard_n, 0.8 * kGuard_n + k * (v * kReact_s + 0.5 * v * v / a));
}

/// Layers with a hand at rest, and both kinds of walls with a moving hand, on one arm after the other.
void add_layered_and_moved(std::vector<Cell>& cells) {
  std::size_t arm = 0;
  for (const double k : kLayered_n_per_m) {
    for (const double v : kLayeredSpeeds_m_per_s) {
      for (std::size_t every = 0; every < kArms.size(); ++every)
        cells.push_back({.arm = every, .wall_n_per_m = k, .wall_m_per_s = v, .layers = true});
      for (const bool layers : {false, true}) {
        for (const double hand : kHands_m_per_s)
          cells.push_back({arm++ % kArms.size(), k, v, false, kGiveWay_m, layers, hand});
        cells.push_back({arm % kArms.size(), k, v, true, kGiveWay_m, layers, kHands_m_per_s[0]});
      }
    }
  }
}

std::vector<Cell> all_cells() {
  std::vector<Cell> cells;
  for (std::size_t arm = 0; arm < kArms.size(); ++arm) {
    for (const double k : kStiffness_n_per_m) {
      for (const double v : kSpeeds_m_per_s) {
        cells.push_back({arm, k, v});
        cells.push_back({arm, k, v, true});
      }
      cells.push_back({arm, k, 0.0, true});
    }
  }
  add_layered_and_moved(cells);
  return cells;
}

struct Sum {
  double runs = 0.0, used_up = 0.0, over_guard = 0.0, over_bound = 0.0, late_s = 0.0, not_reported = 0.0,
         way_m = 0.0, false_signs = 0.0;
  // Results for layers, and with a moving hand for walls and layers, up to 250 N/s and beyond.
  std::array<double, 2> layers_over_guard{};
  std::array<double, 4> moved_over_guard{};
  double moved = 0.0, moved_force_persists = 0.0;
  double signs = 0.0, at_rest = 0.0, near = 0.0, found = 0.0, sign_late_s = 0.0, sign_way_m = 0.0,
         rest_force = 0.0;

  void add(const Cell& c, const Outcome& o) {
    if (c.wrong_sign) return add_sign(c, o);
    if (c.hand_m_per_s > 0.0) return add_moved(c, o);
    runs += 1.0;
    way_m = std::max(way_m, o.way_m);
    false_signs += o.sign_s ? 1.0 : 0.0;
    const bool within = c.wall_n_per_m * c.wall_m_per_s <= kHaste_n_per_s;
    double& over = c.layers ? layers_over_guard[within ? 0 : 1] : within ? over_guard : over_bound;
    over = std::max(over, o.force_n / (within || c.layers ? kGuard_n : bound_n(c)));
    if (!o.used_up) return;
    used_up += 1.0;
    if (!o.stopped_s || !o.reported_s) {
      not_reported += 1.0;
    } else {
      late_s = std::max(late_s, std::abs(*o.reported_s - *o.stopped_s));
    }
  }
  void add_moved(const Cell& c, const Outcome& o) {
    moved += 1.0;
    false_signs += o.sign_s ? 1.0 : 0.0;
    moved_force_persists += o.held == HoldCause::kForcePersists ? 1.0 : 0.0;
    const bool within = c.wall_n_per_m * nears_m_per_s(c) <= kHaste_n_per_s;
    double& over = moved_over_guard[(c.layers ? 2 : 0) + (within ? 0 : 1)];
    over = std::max(over, o.force_n / kGuard_n);
  }
  void add_sign(const Cell& c, const Outcome& o) {
    signs += 1.0;
    if (c.wall_m_per_s == 0.0) {
      at_rest += 1.0;
      rest_force = std::max(rest_force, o.force_n / guard_n(c));
    }
    if (o.near_s) near += 1.0;
    if (!o.sign_s) return;
    found += 1.0;
    sign_way_m = std::max(sign_way_m, o.way_m);
    if (o.near_s) sign_late_s = std::max(sign_late_s, *o.sign_s - *o.near_s);
  }
};

}  // namespace

std::vector<Plot> moving_wall_plots() {
  return {
      {.name = "moving_wall",
       .csv = "moving_wall",
       .title = "An approaching wall: true force / bound, and retreat of the robot (one point per run)",
       .x_column = "growth_n_per_s",
       .x_label = "stiffness times speed (N/s)",
       .panels = {{"force / bound", {{"over_bound", ""}}, ""}, {"retreat (mm)", {{"way_m", "", 1e3}}, ""}}}};
}

std::vector<Metric> run_moving_wall(const ExperimentRun& run) {
  const std::vector<Cell> cells = all_cells();
  std::vector<Outcome> outcomes(cells.size());
  on_all_cores(
      cells.size(), [&](std::size_t i) { outcomes[i] = met(run, cells[i]); }, run.progress);
  Trace trace(
      run.out, "moving_wall",
      {"run", "arm", "wall_n_per_m", "wall_m_per_s", "wrong_sign", "growth_n_per_s", "force_n", "over_bound",
       "way_m", "stopped_s", "told_s", "sign_s", "near_s", "sign_force_n", "layers", "hand_m_per_s", "held"});
  Sum sum;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& c = cells[i];
    const Outcome& o = outcomes[i];
    sum.add(c, o);
    trace.row({static_cast<double>(i), static_cast<double>(c.arm), c.wall_n_per_m, c.wall_m_per_s,
               c.wrong_sign ? 1.0 : 0.0, c.wall_n_per_m * c.wall_m_per_s, o.force_n, o.force_n / bound_n(c),
               o.way_m, o.stopped_s.value_or(-1.0), o.reported_s.value_or(-1.0), o.sign_s.value_or(-1.0),
               o.near_s.value_or(-1.0), o.sign_force_n, c.layers ? 1.0 : 0.0, c.hand_m_per_s,
               static_cast<double>(o.held)});
  }
  trace.close();
  // Control: the metric must be bad for a robot that retreats only as far as a force without a response
  // permits.
  const Outcome control = met(run, {0, 2e3, 0.03, false, 0.02});
  return {{"runs", sum.runs, ""},
          {"force_over_guard_max", sum.over_guard, ""},
          {"force_over_bound_max", sum.over_bound, ""},
          {"layers_force_over_guard_max", sum.layers_over_guard[0], ""},
          {"layers_fast_force_over_guard_max", sum.layers_over_guard[1], ""},
          {"used_up", sum.used_up, ""},
          {"not_told", sum.not_reported, ""},
          {"told_beside_stop_max_s", sum.late_s, "s"},
          {"way_max_m", sum.way_m, "m"},
          {"false_signs", sum.false_signs, ""},
          {"hand_moves_runs", sum.moved, ""},
          {"hand_moves_force_over_guard_max", sum.moved_over_guard[0], ""},
          {"hand_moves_fast_force_over_guard_max", sum.moved_over_guard[1], ""},
          {"hand_moves_layers_force_over_guard_max", sum.moved_over_guard[2], ""},
          {"hand_moves_layers_fast_force_over_guard_max", sum.moved_over_guard[3], ""},
          {"hand_moves_no_relief", sum.moved_force_persists, ""},
          {"wrong_sign_runs", sum.signs, ""},
          {"wrong_sign_pressed", sum.near, ""},
          {"wrong_sign_found", sum.found, ""},
          {"wrong_sign_at_rest_force_over_guard", sum.rest_force, ""},
          {"wrong_sign_way_max_m", sum.sign_way_m, "m"},
          {"wrong_sign_late_max_s", sum.sign_late_s, "s"},
          {"control_force_over_guard", control.force_n / kGuard_n, ""}};
}

}  // namespace longreach
