// Pressing on a wall in rate mode. There is no position to press against, so the force at the hand follows
// the commanded penetration; the slave reports only the stiffness.

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kTowards_m = 0.04;   // deflection of the hand: 70 mm/s with the defaults
constexpr double kNear_m = 0.012;     // 14 mm/s
constexpr double kGentle_m = 0.0055;  // 1 mm/s
constexpr double kHeld_m = 0.003;     // within the dead zone
constexpr double kWall_m = 0.15;

enum class Phase { kTowards, kWait, kPress, kHold, kLeave, kDone };

/// Moves towards the wall, waits for the report of the touch, presses gently, rests in the dead zone, and
/// retreats.
class Person {
 public:
  HandTarget step(const MasterView& m, double t) {
    // The centre of rate mode is the position of the handle at its start.
    if (m.state != SafetyState::kEngaged) {
      began_s_ = t;
      return {};
    }
    const double since = t - began_s_;
    double deflection = 0.0;
    switch (phase_) {
      case Phase::kTowards:
        deflection = m.goal_m.x() < 0.8 * kWall_m ? kTowards_m : kNear_m;
        go(m.goal_m.x() > kWall_m + 0.002, Phase::kWait, t);
        break;
      case Phase::kWait:
        go(m.stiffness_n_per_m > 1.0 && since > 5.0, Phase::kPress, t);
        break;
      case Phase::kPress:
        deflection = kGentle_m;
        go(m.spring_force_n.norm() > 4.0 || since > 20.0, Phase::kHold, t);
        break;
      case Phase::kHold:  // on the side of the wall; there is no force beyond the centre
        deflection = kHeld_m;
        go(since > 8.0, Phase::kLeave, t);
        break;
      case Phase::kLeave:
        deflection = -kTowards_m;
        go(since > 4.0, Phase::kDone, t);
        break;
      case Phase::kDone:
        break;
    }
    HandTarget target;
    target.position_m = {deflection * gain_, 0.0, 0.0};
    if (phase_ == Phase::kHold)
      target.position_m.x() += m.spring_force_n.norm() / hand_model(Grip::kFirm).stiffness_n_per_m;
    target.grip = Grip::kFirm;
    return target;
  }
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] double since(double t) const { return t - began_s_; }
  /// A compliant hand must aim beyond the intended deflection.
  void lean(double gain) { gain_ = gain; }

 private:
  void go(bool now, Phase next, double t) {
    if (!now) return;
    phase_ = next;
    began_s_ = t;
  }
  Phase phase_ = Phase::kTowards;
  double began_s_ = 0.0;
  double gain_ = 1.0;
};

}  // namespace

std::vector<Plot> rate_contact_plots() {
  return {{.name = "rate-contact",
           .csv = "rate-contact",
           .title = "Rate mode on a wall of 1 N/mm",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"handle (mm)", {{"hand_m", "deflection", 1e3}}, ""},
                      {"depth (mm)", {{"depth_m", "goal behind the wall", 1e3}}, ""},
                      {"contact force (N)", {{"felt_n", "at the hand"}, {"tool_n", "at the tool"}}, ""},
                      {"energy (mJ)",
                       {{"port_energy_j", "into the device", 1e3}, {"tank_j", "in the tank", 1e3}},
                       ""}}}};
}

std::vector<Metric> run_rate_contact(const ExperimentRun& run) {
  MasterConfig master = to_struct(run.config.master());
  SlaveConfig slave = to_struct(run.config.slave());
  master.mapping.mode = MotionMode::kRate;
  slave.scene.surface.resize(1);
  slave.scene.surface[0].plane = {.point_m = {kWall_m, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
  Laboratory lab(master, slave, run.seed);
  Person person;
  const double k_f = master.rendering.rate_stiffness_n_per_m;
  const HandModel hand = hand_model(Grip::kFirm);
  person.lean(1.0 + k_f / hand.stiffness_n_per_m);
  Trace trace(run.out, "rate-contact",
              {"t_s", "hand_m", "depth_m", "felt_n", "tool_n", "port_energy_j", "tank_j"});
  double felt_sum = 0.0, tool_sum = 0.0, rise_max_n = 0.0, last_n = 0.0;
  int samples = 0;
  for (int i = 0; i < 120000 && person.phase() != Phase::kDone; ++i) {
    lab.drive(person.step(lab.master(), lab.now_s()));
    lab.step();
    const MasterView& m = lab.master();
    const double felt_n = m.spring_force_n.norm(), tool_n = lab.arm().true_wrench().force.norm();
    rise_max_n = std::max(rise_max_n, felt_n - last_n);
    last_n = felt_n;
    if (person.phase() == Phase::kHold && person.since(lab.now_s()) > 6.0) {
      felt_sum += felt_n;
      tool_sum += tool_n;
      ++samples;
    }
    if (i % 20 == 0)
      trace.row({lab.now_s(), m.p_MH.x(), m.goal_m.x() - kWall_m, felt_n, tool_n, m.port_energy_j, m.tank_j});
  }
  trace.close();
  const MasterView& m = lab.master();
  return {{"duration_s", lab.now_s(), "s"},
          {"felt_n", felt_sum / std::max(samples, 1), "N"},
          {"tool_force_n", tool_sum / std::max(samples, 1), "N"},
          {"felt_over_tool_force", felt_sum / std::max(tool_sum, 1e-9), ""},
          {"force_rise_max_n", rise_max_n, "N"},
          {"left", m.spring_force_n.norm() < 0.1 ? 1.0 : 0.0, ""},
          {"port_energy_min_j", m.port_energy_min_j, "J"},
          {"energy_drawdown_j", m.energy_drawdown_j, "J"}};
}

}  // namespace longreach
