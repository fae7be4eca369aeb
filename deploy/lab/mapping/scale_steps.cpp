// The buttons step the scale from 0.8 down to 0.05 and up again while the hand moves in a circle in position
// mode. Measures the steps of goal and force, and checks that the displayed friction is f / k_scale.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kEngagedWithin_s = 30.0;  // time limit for the engagement
constexpr double kBegin_s = 3.0;           // start of the steps after the engagement
constexpr double kStep_s = 1.5;            // time between two steps
constexpr int kSteps = 15;                 // steps down, and as many up
constexpr double kPressed_s = 0.1;
constexpr double kRadius_m = 0.015, kTurn_s = 4.0, kGentle_s = 0.5;

/// The hand on a circle in the y-z plane, parallel to the wall that the scene may have. It starts gently.
HandTarget hand_at(double t, Grip grip) {
  const double late_s = kGentle_s * (1.0 - std::exp(-t / kGentle_s));
  const double angle = 2.0 * std::numbers::pi * (t - late_s) / kTurn_s;
  HandTarget hand;
  hand.position_m = kRadius_m * Vector3(0.0, std::sin(angle), 1.0 - std::cos(angle));
  hand.velocity_m_per_s = 2.0 * std::numbers::pi / kTurn_s * (1.0 - std::exp(-t / kGentle_s)) * kRadius_m *
                          Vector3(0.0, std::cos(angle), std::sin(angle));
  hand.grip = grip;
  const double since = t - kBegin_s;
  const int step = static_cast<int>(std::floor(since / kStep_s));
  const bool pressed = since >= 0.0 && since - step * kStep_s < kPressed_s;
  hand.buttons.scale_down = pressed && step < kSteps;
  hand.buttons.scale_up = pressed && step >= kSteps && step < 2 * kSteps;
  return hand;
}

struct Watch {
  double scale = 0.0;
  Vector3 goal_m = Vector3::Zero(), force_n = Vector3::Zero();
  double since_s = 0.0;  // time of the last step
  int steps = 0;
  double goal_step_m = 0.0, goal_tick_m = 0.0;    // largest, in ticks with and without a step of the scale
  double force_step_n = 0.0, force_tick_n = 0.0;  // likewise
  double friction_error = 0.0;                    // share, largest from three fades after a step on

  void sample(const MasterView& m, const RenderingConfig& config, double dt_s) {
    const bool stepped = m.scale != scale;
    const double goal = (m.goal_m - goal_m).norm(), force = (m.F_H_M.force - force_n).norm();
    (stepped ? goal_step_m : goal_tick_m) = std::max(stepped ? goal_step_m : goal_tick_m, goal);
    (stepped ? force_step_n : force_tick_n) = std::max(stepped ? force_step_n : force_tick_n, force);
    steps += stepped;
    since_s = stepped ? 0.0 : since_s + dt_s;
    scale = m.scale;
    goal_m = m.goal_m;
    force_n = m.F_H_M.force;
    if (steps > 0 && since_s > 5.0 * config.fade_s)
      friction_error = std::max(friction_error, std::abs(force_n.norm() * scale / config.friction_n - 1.0));
  }
};

}  // namespace

std::vector<Plot> scale_steps_plots() {
  return {{.name = "scale-steps",
           .csv = "scale-steps",
           .title = "Step changes of the scale while the hand moves in a circle",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"handle (mm)", {{"hand_y_m", "y", 1e3}, {"hand_z_m", "z", 1e3}}, ""},
                      {"commanded (mm)", {{"goal_y_m", "y", 1e3}, {"goal_z_m", "z", 1e3}}, ""},
                      {"k_{scale}", {{"scale", "scale"}}, "set yrange [0:1]"},
                      {"friction (N)",
                       {{"friction_n", "at the hand"}, {"friction_law_n", "f / k_{scale}"}},
                       "set yrange [0:*]"}}}};
}

std::vector<Metric> run_scale_steps(const ExperimentRun& run) {
  MasterConfig master = to_struct(run.config.master());
  master.mapping.mode = MotionMode::kPosition;
  Laboratory lab(master, to_struct(run.config.slave()), run.seed);
  lab.drive(hand_at(0.0, master.hand.grip));
  while (lab.now_s() < kEngagedWithin_s && lab.master().state != SafetyState::kEngaged) lab.step();

  Trace trace(
      run.out, "scale-steps",
      {"t_s", "hand_y_m", "hand_z_m", "goal_y_m", "goal_z_m", "scale", "friction_n", "friction_law_n"});
  Watch watch{.scale = lab.master().scale, .goal_m = lab.master().goal_m};
  const double shown_s = kBegin_s + 2.0 * kSteps * kStep_s + 1.0;
  const auto ticks = static_cast<int>(shown_s / lab.period_s());
  for (int i = 0; i < ticks; ++i) {
    const double t = i * lab.period_s();
    lab.drive(hand_at(t, master.hand.grip));
    lab.step();
    const MasterView& m = lab.master();
    watch.sample(m, master.rendering, lab.period_s());
    if (i % 20 == 0)
      trace.row({t, m.p_MH.y(), m.p_MH.z(), m.goal_m.y(), m.goal_m.z(), m.scale, m.F_H_M.force.norm(),
                 master.rendering.friction_n / m.scale});
    if (run.progress && i % 500 == 0) run.progress(static_cast<double>(i) / ticks);
  }
  trace.close();
  if (run.progress) run.progress(1.0);
  return {{"scale_steps", static_cast<double>(watch.steps), ""},
          {"goal_step_max_m", watch.goal_step_m, "m"},
          {"goal_tick_max_m", watch.goal_tick_m, "m"},
          {"force_step_max_n", watch.force_step_n, "N"},
          {"force_tick_max_n", watch.force_tick_n, "N"},
          {"friction_error_max", watch.friction_error, ""},
          {"port_energy_min_j", lab.master().port_energy_min_j, "J"},
          {"energy_drawdown_j", lab.master().energy_drawdown_j, "J"}};
}

}  // namespace longreach
