// The main experiment: the simulated operator touches the wall of the scene twice over the link, presses and
// probes.
//
// The displayed stiffness is the least-squares slope of the rendered spring force over the position of the
// handle along the normal, from samples above 0.2 N that are not clamped. It is evaluated from the second
// touch on, when the wall is known before the hand arrives (the force of a wall that is reported late is
// limited by the energy store, see the experiment `person`), and from RTT + 1 s on after each hold. Each
// tangent has its own intercept, because the wall is at another position of the handle. The reference is the
// slope, over the same samples, of a spring with ke times the true tangent stiffness of the material at the
// position for which the slave reported it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "common/config/config.hpp"
#include "common/core/regression.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/plot.hpp"
#include "deploy/lab/touch.hpp"
#include "deploy/lab/trace.hpp"
#include "slave/simulation/scene/scene.hpp"

namespace longreach {
namespace {

constexpr double kSpringLeast_n = 0.2;

/// Values measured during the run.
struct Watch {
  HapticReturn return_before{}, return_after{};  // while probing
  double return_s = 0.0;
  LineFit displayed;
  LineFit reference;  // of a spring with ke times the true tangent, over the same samples
  double rendered_n_per_m = 0.0, true_n_per_m = 0.0;
  double displayed_span_s = 0.0;
  double first_touch_s = -1.0;
  bool again = false;         // it is the second touch, or a later one
  double unsettled_s = -1.0;  // when the hand was last in a hold
  double force_step_max_n = 0.0;
  double force_step_excess_n = 0.0;  // over max(0.1 N, 5 % of the force)
  double force_rise_excess_n = 0.0;  // likewise, of a step that makes it greater
  double registration_m = -1.0;      // at the second touch
  double force_peak_n = 0.0;         // at the tool
  double speed_peak_m_per_s = 0.0;   // of the hand
  double rtt_s = 0.0;
  double estimate_sd = 1.0;  // of the slave's estimate, relative, when last in contact while probing
  std::uint64_t reports = 0;
  bool cut = false;  // true if the wall is stiffer than the device can render
  ScriptPhase phase = ScriptPhase::kWaiting;
};

// Into the wall, where the scene has one.
std::optional<Vector3> inward_of(const SlaveConfig& slave) {
  const auto& surface = slave.scene.surface;
  if (surface.empty() || !surface.front().plane) return std::nullopt;
  return Vector3(-surface.front().plane->normal.normalized());
}

/// Distance of the rendered surface, at its point nearest to the handle, from the nearest true surface of any
/// shape; in m of the handle, position mode.
double registration_error_m(const Laboratory& lab, const SlaveConfig& slave, const Vector3& base_rad) {
  constexpr double kReach_m =
      1.0;  // a tool as large as this touches whatever is near, and its depth says how near
  SceneConfig scene = slave.scene;
  const double tool_m = std::exchange(scene.tool_radius_m, kReach_m);
  const MasterView& m = lab.master();
  const double depth_m = m.inward.dot(m.p_MH) - m.surface_m;
  const Vector3 inward = exp_rotation(base_rad) * m.inward;
  const Vector3 rendered_m = lab.slave().X_WE_anchor.p + m.goal_m - m.scale * depth_m * inward;
  const Scene true_scene(scene, lab.arm().start_pose());
  const double distance_m =
      kReach_m - true_scene.contact({.p_WE = rendered_m, .t_s = lab.now_s()}).depth_m - tool_m;
  return std::abs(distance_m) / m.scale;
}

void watch_tick(Watch& w, const Laboratory& lab, const MasterConfig& master, const SlaveConfig& slave) {
  const MasterView& m = lab.master();
  const double spring_n = m.spring_force_n.norm();
  w.force_peak_n = std::max(w.force_peak_n, lab.arm().true_wrench().force.norm());
  w.speed_peak_m_per_s = std::max(w.speed_peak_m_per_s, lab.devices().delta().velocity_m_per_s().norm());
  if (m.reports != w.reports) {
    w.reports = m.reports;
    const double allowed_n = std::max(0.1, 0.05 * spring_n);
    w.force_step_max_n = std::max(w.force_step_max_n, std::abs(m.force_step_n));
    w.force_step_excess_n = std::max(w.force_step_excess_n, std::abs(m.force_step_n) - allowed_n);
    w.force_rise_excess_n = std::max(w.force_rise_excess_n, m.force_step_n - allowed_n);
  }
  if (w.first_touch_s < 0.0 && lab.arm().true_penetration_m() > 0.0) {
    w.first_touch_s = lab.now_s();
    w.rtt_s = lab.link().rtt_s.value_or(0.0);
  }
  const ScriptPhase phase = lab.script().phase();
  if (phase == ScriptPhase::kPress && w.phase == ScriptPhase::kReturn && w.registration_m < 0.0 &&
      m.surface_known && !slave.scene.surface.empty())
    w.registration_m = registration_error_m(lab, slave, master.mapping.base_rotation_rad);
  if (phase == ScriptPhase::kProbe) {
    if (w.phase != phase) w.return_before = lab.haptic_return();
    w.return_s += lab.period_s();
    w.return_after = lab.haptic_return();
    const ContactEstimate& e = lab.slave().estimate;
    if (lab.slave().in_contact && e.stiffness_n_per_m > 0.0)
      w.estimate_sd = e.stiffness_sd_n_per_m / e.stiffness_n_per_m;
  }
  if (phase == ScriptPhase::kPress && w.phase == ScriptPhase::kReturn) w.again = true;
  w.phase = phase;
  if (w.first_touch_s < 0.0) return;
  if (m.state != SafetyState::kEngaged) w.unsettled_s = lab.now_s();
  // Another tangent of a nonlinear law has another intercept.
  w.cut = w.cut || m.stiffness_clamped;
  const double true_n_per_m = master.rendering.ke * lab.arm().material_stiffness(lab.rendered_at_m());
  const bool other = m.stiffness_n_per_m != w.rendered_n_per_m || true_n_per_m != w.true_n_per_m;
  if (m.state != SafetyState::kEngaged || other) {
    w.displayed.begin_group();
    w.reference.begin_group();
  }
  w.rendered_n_per_m = m.stiffness_n_per_m;
  w.true_n_per_m = true_n_per_m;
  if (!w.again || lab.now_s() < std::max(w.first_touch_s, w.unsettled_s) + w.rtt_s + 1.0) return;
  if (spring_n > kSpringLeast_n && !m.force_clamped && m.mode == MotionMode::kPosition) {
    const double in_m = m.inward.dot(m.p_MH);
    w.displayed.add(in_m, spring_n);
    w.reference.add(in_m, true_n_per_m * in_m);
    w.displayed_span_s += lab.period_s();
  }
}

/// Metrics of a wall that was touched.
void add_contact(std::vector<Metric>& metrics, const Watch& w, const MasterView& m) {
  const double reference = w.reference.slope(), displayed = w.displayed.slope();
  const double error = reference > 0.0 ? std::abs(displayed - reference) / reference : 1.0;
  const double rendered_error =
      w.true_n_per_m > 0.0 ? std::abs(m.stiffness_n_per_m - w.true_n_per_m) / w.true_n_per_m : 1.0;
  metrics.insert(metrics.end(), {{"displayed_stiffness_n_per_m", displayed, "N/m"},
                                 {"reference_stiffness_n_per_m", reference, "N/m"},
                                 {"displayed_stiffness_error", error, ""},
                                 {"displayed_span_s", w.displayed_span_s, "s"},
                                 {"rendered_stiffness_n_per_m", m.stiffness_n_per_m, "N/m"},
                                 {"rendered_stiffness_error", rendered_error, ""},
                                 {"stiffness_max_n_per_m", m.stiffness_max_n_per_m, "N/m"},
                                 {"stiffness_cut", w.cut ? 1.0 : 0.0, ""},
                                 {"estimate_sd", w.estimate_sd, ""}});
  if (w.registration_m >= 0.0) metrics.push_back({"wall_registration_error_m", w.registration_m, "m"});
}

std::vector<Metric> metrics_of(const Watch& w, const Laboratory& lab) {
  const MasterView& m = lab.master();
  const SlaveView& s = lab.slave();
  const double probed_s = std::max(w.return_s, lab.period_s());
  const bool contact = w.first_touch_s >= 0.0;
  std::vector<Metric> metrics{{"contact", contact ? 1.0 : 0.0, ""}};
  if (contact) add_contact(metrics, w, m);
  for (const TouchedGeom& geom : lab.arm().touched()) {
    metrics.push_back({"geom_force_max_n." + geom.name, geom.force_max_n, "N"});
    metrics.push_back({"geom_depth_max_m." + geom.name, geom.depth_max_m, "m"});
  }
  metrics.insert(
      metrics.end(),
      {{"port_energy_min_j", m.port_energy_min_j, "J"},
       {"energy_drawdown_j", m.energy_drawdown_j, "J"},
       {"force_step_at_update_max_n", w.force_step_max_n, "N"},
       {"force_step_excess_n", w.force_step_excess_n, "N"},
       {"force_rise_excess_n", w.force_rise_excess_n, "N"},
       {"tool_force_peak_n", w.force_peak_n, "N"},
       {"hand_speed_peak_m_per_s", w.speed_peak_m_per_s, "m/s"},
       {"rtt_s", contact ? w.rtt_s : lab.link().rtt_s.value_or(0.0), "s"},
       {"probing_cycles_done", static_cast<double>(lab.script().cycles()), ""},
       {"reports_applied", static_cast<double>(m.reports), ""},
       {"rejected_datagrams",
        static_cast<double>(lab.master_port().rejected_total() + lab.slave_port().rejected_total()), ""},
       {"rejected_values", static_cast<double>(m.rejected_values + s.rejected_values), ""},
       {"false_holds", static_cast<double>(m.false_holds + s.false_holds), ""},
       {"limit_violations", static_cast<double>(s.limit_violations), ""},
       {"sensor_faulted", s.cause == HoldCause::kSensorFault ? 1.0 : 0.0, ""},
       {"haptic_return_datagrams_per_s",
        static_cast<double>(w.return_after.datagrams - w.return_before.datagrams) / probed_s, "1/s"},
       {"haptic_return_bit_per_s",
        8.0 * static_cast<double>(w.return_after.bytes - w.return_before.bytes) / probed_s, "bit/s"},
       {"duration_s", lab.now_s(), "s"}});
  return metrics;
}

// Evaluated along the normal of the wall. Forces along other normals are excluded.
std::vector<double> row_of(const Laboratory& lab, const std::optional<Vector3>& wall) {
  constexpr double kAlong = 0.9;  // cosine
  const MasterView& m = lab.master();
  const SlaveView& s = lab.slave();
  const Vector3 inward = wall.value_or(m.inward);
  const bool along = m.inward.dot(inward) > kAlong;
  return {lab.now_s(),
          inward.dot(m.p_MH),
          along && m.surface_known ? m.surface_m : NAN,
          inward.dot(m.goal_m),
          s.engagement > 0 ? inward.dot(s.X_WE.p - s.X_WE_anchor.p) : NAN,
          -inward.dot(m.F_H_M.force),
          m.spring_force_n.norm(),
          lab.arm().true_wrench().force.norm(),
          along ? m.stiffness_n_per_m : NAN,
          s.reported_stiffness_n_per_m,
          lab.arm().true_penetration_m(),
          m.port_energy_j,
          m.stored_energy_j,
          m.tank_j,
          m.scale,
          static_cast<double>(m.mode),
          static_cast<double>(m.state),
          static_cast<double>(lab.script().phase())};
}

}  // namespace

std::vector<Plot> touch_plots() {
  return {{.name = "touch",
           .csv = "touch",
           .title = "Touching a wall across the link",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"handle (mm)", {{"hand_m", "hand", 1e3}, {"surface_m", "registered wall", 1e3}}, ""},
                      {"tool (mm)",
                       {{"goal_m", "commanded", 1e3},
                        {.column = "tool_m", .title = "measured", .factor = 1e3, .dashed = true}},
                       ""},
                      {"force (N)",
                       {{"spring_force_n", "on the hand, from contact"}, {"tool_force_n", "at the tool"}},
                       ""},
                      {"stiffness (N/mm)",
                       {{"stiffness_n_per_m", "rendered", 1e-3},
                        {.column = "reported_n_per_m",
                         .title = "reported by the slave",
                         .factor = 1e-3,
                         .dashed = true}},
                       "set yrange [0:*]"},
                      {"energy (mJ)",
                       {{"port_energy_j", "into the device", 1e3},
                        {.column = "stored_energy_j", .title = "stored", .factor = 1e3, .dashed = true}},
                       ""}}}};
}

struct TouchRun::State {
  State(const proto::LabConfig& config, std::uint64_t seed)
      : master(to_struct(config.master())),
        slave(to_struct(config.slave())),
        lab(master, slave, seed),
        wall(inward_of(slave)),
        ticks(static_cast<std::int64_t>(config.duration_s() / lab.period_s())),
        ticks_per_row(std::max<std::int64_t>(1, std::llround(1.0 / (config.trace_hz() * lab.period_s())))) {}

  MasterConfig master;
  SlaveConfig slave;
  Laboratory lab;
  Watch watch{};
  std::optional<Vector3> wall;
  std::int64_t ticks, ticks_per_row, done = 0;
};

TouchRun::TouchRun(const proto::LabConfig& config, std::uint64_t seed)
    : state_(std::make_unique<State>(config, seed)) {}
TouchRun::~TouchRun() = default;

void TouchRun::step() {
  State& s = *state_;
  s.lab.step();
  watch_tick(s.watch, s.lab, s.master, s.slave);
  ++s.done;
}

bool TouchRun::done() const {
  const ScriptedOperator& script = state_->lab.script();
  return state_->done >= state_->ticks || (script.cycles() > 0 && script.phase() == ScriptPhase::kRest);
}

double TouchRun::completed() const {
  return static_cast<double>(state_->done) / static_cast<double>(std::max<std::int64_t>(state_->ticks, 1));
}

std::vector<Metric> TouchRun::metrics() const { return metrics_of(state_->watch, state_->lab); }

const std::vector<std::string_view>& TouchRun::columns() {
  static const std::vector<std::string_view> names{"t_s",
                                                   "hand_m",
                                                   "surface_m",
                                                   "goal_m",
                                                   "tool_m",
                                                   "hand_force_n",
                                                   "spring_force_n",
                                                   "tool_force_n",
                                                   "stiffness_n_per_m",
                                                   "reported_n_per_m",
                                                   "penetration_m",
                                                   "port_energy_j",
                                                   "stored_energy_j",
                                                   "tank_j",
                                                   "scale",
                                                   "mode",
                                                   "state",
                                                   "phase"};
  return names;
}

bool TouchRun::row_is_due() const { return (state_->done - 1) % state_->ticks_per_row == 0; }
std::vector<double> TouchRun::row() const { return row_of(state_->lab, state_->wall); }
Laboratory& TouchRun::laboratory() { return state_->lab; }
const Laboratory& TouchRun::laboratory() const { return state_->lab; }

namespace {

std::vector<Metric> touch(const ExperimentRun& run, const std::filesystem::path& record) {
  constexpr int kProgressTicks = 1000;
  TouchRun touch(run.config, run.seed);
  if (!record.empty()) touch.laboratory().record(record);
  Trace trace(run.out, "touch", TouchRun::columns());
  for (int i = 0; !touch.done(); ++i) {
    touch.step();
    if (touch.row_is_due()) trace.row(touch.row());
    if (run.progress && i % kProgressTicks == 0) run.progress(touch.completed());
  }
  trace.close();
  touch.laboratory().end_recording();
  if (run.progress) run.progress(1.0);
  return touch.metrics();
}

}  // namespace

std::vector<Metric> run_touch(const ExperimentRun& run) { return touch(run, {}); }

std::vector<Metric> run_touch_recorded(const ExperimentRun& run) {
  return touch(run, run.out / "touch.mcap");
}

}  // namespace longreach
