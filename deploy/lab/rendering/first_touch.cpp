// The first touch of an unknown wall: fast, stiff and with a long delay. The hand continues for one round
// trip until the report arrives. The force must not jump then, and the second touch must be displayed at the
// position of the wall. Meanwhile the slave is protected by its force guard (first_touch_guard.hpp).

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/rendering/first_touch_guard.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kRoundTrip_s = 3.0;
constexpr double kSpeed_m_per_s = 0.05;
constexpr double kCreep_m_per_s = 0.003;
constexpr double kWall_n_per_m = 5000.0;
constexpr double kWall_m = 0.03;    // distance from the start of the tool
constexpr double kStart_m = -0.06;  // of the handle
constexpr double kEnd_m = 0.05;

enum class Phase { kSettle, kRun, kCreep, kReact, kRetreat, kReturn, kPress, kDone };

struct TouchSeen {
  double crossed_s = -1.0;      // time at which the goal passes the wall
  double felt_s = -1.0;         // time at which the contact force at the hand exceeds 0.5 N
  double step_max_n = 0.0;      // maximum step of the contact force in one tick, until it is felt
  double registration_m = 0.0;  // position of the second touch at the hand
  double force_max_n = 0.0;     // at the tool
  double energy_min_j = 0.0;
  double drawdown_j = 0.0;
};

MasterConfig prepared(MasterConfig config, Registration registration) {
  config.rendering.registration = registration;
  config.mapping.mode = MotionMode::kPosition;
  config.mapping.scale = 1.0;
  config.hand.grip = Grip::kFirm;
  return config;
}

SlaveConfig prepared(SlaveConfig config) {
  config.scene.material.resize(1);
  config.scene.material[0].stiffness_n_per_m = kWall_n_per_m;
  config.scene.surface.resize(1);
  config.scene.surface[0].material = config.scene.material[0].name;
  config.scene.surface[0].plane = {.point_m = {kWall_m, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
  return config;
}

/// The motion of the person along x.
class Person {
 public:
  HandTarget step(const MasterView& view, double t, double dt_s) {
    if (phase_ == Phase::kSettle && view.state != SafetyState::kEngaged) began_s_ = t;
    const double felt_n = view.spring_force_n.norm(), handle_m = view.p_MH.x();
    double speed = 0.0;
    switch (phase_) {
      case Phase::kSettle:  // at the start, clutched until there
        reach_m_ += std::clamp(kStart_m - reach_m_, -0.05 * dt_s, 0.05 * dt_s);
        go(t - began_s_ > 1.0 && std::abs(handle_m - kStart_m) < 2e-3, Phase::kRun, t);
        break;
      case Phase::kRun:
        speed = kSpeed_m_per_s;
        go(reach_m_ > kEnd_m, Phase::kCreep, t);
        break;
      case Phase::kCreep:
        speed = kCreep_m_per_s;
        go(felt_n > 0.5, Phase::kReact, t);
        break;
      case Phase::kReact:
        go(t - began_s_ > 0.25, Phase::kRetreat, t);
        break;
      case Phase::kRetreat:
        speed = -0.03;
        go(view.surface_known && handle_m < view.surface_m - 0.01, Phase::kReturn, t);
        break;
      case Phase::kReturn:
        speed = 0.02;
        go(felt_n > 1.0, Phase::kPress, t);
        break;
      case Phase::kPress:
        go(t - began_s_ > 1.0, Phase::kDone, t);
        break;
      case Phase::kDone:
        break;
    }
    reach_m_ += speed * dt_s;
    HandTarget target;
    target.position_m = {reach_m_, 0.0, 0.0};
    target.velocity_m_per_s = {speed, 0.0, 0.0};
    target.grip = Grip::kFirm;
    target.buttons.clutch = phase_ == Phase::kSettle;
    return target;
  }
  [[nodiscard]] Phase phase() const { return phase_; }

 private:
  void go(bool now, Phase next, double t) {
    if (!now) return;
    phase_ = next;
    began_s_ = t;
  }
  Phase phase_ = Phase::kSettle;
  double began_s_ = 0.0;
  double reach_m_ = 0.0;
};

TouchSeen touch(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed, Trace* trace) {
  Laboratory lab(master, slave, seed);
  Person person;
  TouchSeen seen;
  double last_n = 0.0;
  for (int i = 0; i < 60000 && person.phase() != Phase::kDone; ++i) {
    lab.drive(person.step(lab.master(), lab.now_s(), lab.period_s()));
    lab.step();
    const MasterView& m = lab.master();
    const double felt_n = m.spring_force_n.norm();
    if (seen.crossed_s < 0.0 && m.goal_m.x() > kWall_m) seen.crossed_s = lab.now_s();
    if (seen.felt_s < 0.0) {
      seen.step_max_n = std::max(seen.step_max_n, felt_n - last_n);
      if (felt_n > 0.5) seen.felt_s = lab.now_s();
    }
    last_n = felt_n;
    if (m.surface_known) {  // as it was last
      const double true_surface_m = m.p_MH.x() - (m.goal_m.x() - kWall_m);
      seen.registration_m = m.surface_m - true_surface_m;
    }
    seen.force_max_n = std::max(seen.force_max_n, lab.arm().true_wrench().force.norm());
    seen.energy_min_j = m.port_energy_min_j;
    seen.drawdown_j = m.energy_drawdown_j;
    if (trace && i % 10 == 0) {
      trace->row({lab.now_s(), m.p_MH.x(), m.surface_known ? m.surface_m : std::nan(""),
                  m.goal_m.x() - kWall_m, felt_n, lab.arm().true_wrench().force.norm()});
    }
  }
  return seen;
}

}  // namespace

std::vector<Plot> first_touch_plots() {
  return {
      {.name = "first-touch",
       .csv = "first-touch",
       .title = "Touching a wall of 5 N/mm at 50 mm/s with a round-trip time of 3 s",
       .x_column = "t_s",
       .x_label = "time (s)",
       .panels = {{"handle (mm)", {{"hand_m", "hand", 1e3}, {"surface_m", "registered wall", 1e3}}, ""},
                  {"depth of the goal (mm)", {{"goal_depth_m", "commanded", 1e3}}, ""},
                  {"force (N)", {{"felt_n", "on the hand, from contact"}, {"tool_n", "at the tool"}}, ""}}},
      first_touch_guard_plot()};
}

std::vector<Metric> run_first_touch(const ExperimentRun& run) {
  MasterConfig master = to_struct(run.config.master());
  SlaveConfig slave = prepared(to_struct(run.config.slave()));
  master.link.impairment = slave.link.impairment = ImpairmentConfig{.delay_s = 0.5 * kRoundTrip_s};
  Trace trace(run.out, "first-touch", {"t_s", "hand_m", "surface_m", "goal_depth_m", "felt_n", "tool_n"});
  const TouchSeen ours = touch(prepared(master, Registration::kTouch), slave, run.seed, &trace);
  trace.close();
  if (run.progress) run.progress(0.5);
  const TouchSeen control = touch(prepared(master, Registration::kArrival), slave, run.seed, nullptr);
  const std::vector<Metric> guard = run_first_touch_guard(run.out);
  if (run.progress) run.progress(1.0);
  std::vector<Metric> metrics{
      {"round_trip_s", kRoundTrip_s, "s"},
      {"felt_after_s", ours.felt_s - ours.crossed_s, "s"},
      {"felt_after_round_trip_s", ours.felt_s - ours.crossed_s - kRoundTrip_s, "s"},
      {"force_step_max_n", ours.step_max_n, "N"},
      {"registration_error_m", std::abs(ours.registration_m), "m"},
      {"registration_error_without_touch_sequence_m", std::abs(control.registration_m), "m"},
      {"tool_force_max_n", ours.force_max_n, "N"},
      {"port_energy_min_j", ours.energy_min_j, "J"},
      {"energy_drawdown_j", ours.drawdown_j, "J"}};
  metrics.insert(metrics.end(), guard.begin(), guard.end());
  return metrics;
}

}  // namespace longreach
