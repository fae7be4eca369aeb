// During a contact, the one-way delay steps from 0.4 s to 6 s for one minute, as in the Interact experiment.
// The force must decrease without jumps, and the work must continue after a new engagement.

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kSpike_s = 30.0;  // the hand presses by this time
constexpr double kSpikeLength_s = 60.0;
constexpr double kDuration_s = 160.0;
constexpr const char* kStateAxis =
    "set yrange [-0.3:3.3]\nset ytics ('idle' 0, 'observing' 1, 'engaged' 2, 'holding' 3)";

/// Evaluates the force tick by tick.
class Spike {
 public:
  explicit Spike(double fade_s) : fade_s_(fade_s) {}

  void watch(const Laboratory& lab) {
    const MasterView& m = lab.master();
    const double t = lab.now_s(), felt_n = m.spring_force_n.norm(), half_tick_s = 0.6 * lab.period_s();
    if (std::abs(t - kSpike_s) < half_tick_s) in_contact_n = felt_n;
    if (t > kSpike_s && t < kSpike_s + kSpikeLength_s) rise_max_n = std::max(rise_max_n, felt_n - last_n_);
    if (t > kSpike_s && held_s < 0.0 && m.state == SafetyState::kHolding) {
      held_s = t - kSpike_s;
      stiffness_at_hold = m.stiffness_n_per_m;
    }
    if (held_s >= 0.0) {
      const double since = t - kSpike_s - held_s;
      if (std::abs(since - fade_s_) < half_tick_s) stiffness_later = m.stiffness_n_per_m;
      if (std::abs(since - 2.0) < half_tick_s) residual_n = felt_n;
    }
    if (m.state == SafetyState::kEngaged && m.engagement != engagement_) {
      engagement_ = m.engagement;
      ++engagements;
      engaged_since_s_ = t;
    }
    pressed_again = pressed_again || (engagements > 1 && felt_n > 2.0 && t > engaged_since_s_ + 5.0);
    last_n_ = felt_n;
  }

  double in_contact_n = 0.0;  // force when the spike began
  double held_s = -1.0;       // time from the start of the spike to the hold of the master
  double stiffness_at_hold = 0.0;
  double stiffness_later = 0.0;  // one time constant later
  double rise_max_n = 0.0;       // maximum step of the contact force in one tick after the spike began
  double residual_n = 0.0;       // force two seconds after the hold
  int engagements = 0;
  bool pressed_again = false;

 private:
  double fade_s_;
  double last_n_ = 0.0;
  double engaged_since_s_ = -1.0;
  std::uint32_t engagement_ = 0;
};

void spike_into(ImpairmentConfig& way) {
  way = {.delay_s = 0.4, .jitter_s = 0.02, .loss = 0.015};
  way.step_delay_s = 5.6;
  way.step_start_s = kSpike_s;
  way.step_duration_s = kSpikeLength_s;
  way.blackout_start_s = kSpike_s;
  way.blackout_duration_s = 1.0;
}

}  // namespace

std::vector<Plot> spike_plots() {
  return {{.name = "spike",
           .csv = "spike",
           .title = "The round trip jumps to 12 s during contact (at 30 s, for 60 s)",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"contact force (N)", {{"felt_n", "at the hand"}, {"tool_n", "at the tool"}}, ""},
                      {"stiffness (N/mm)", {{"stiffness_n_per_m", "rendered", 1e-3}}, "set yrange [0:*]"},
                      {"energy (mJ)", {{"port_energy_j", "into the device", 1e3}}, ""},
                      {"", {{"state", "state"}}, kStateAxis}}}};
}

std::vector<Metric> run_spike(const ExperimentRun& run) {
  MasterConfig master = to_struct(run.config.master());
  SlaveConfig slave = to_struct(run.config.slave());
  spike_into(master.link.impairment);
  spike_into(slave.link.impairment);
  // A nearby wall, and a script that stays in contact until the spike.
  slave.scene.surface.resize(1);
  slave.scene.surface[0].plane = {.point_m = {0.02, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
  master.operator_.rate_distance_m = 0.0;
  master.operator_.probe_cycles = 1000;

  Laboratory lab(master, slave, run.seed);
  Trace trace(run.out, "spike", {"t_s", "felt_n", "tool_n", "stiffness_n_per_m", "port_energy_j", "state"});
  Spike s(master.rendering.fade_s);
  const MasterView& m = lab.master();
  const auto ticks = static_cast<std::int64_t>(kDuration_s / lab.period_s());
  for (std::int64_t i = 0; i < ticks; ++i) {
    // The person engages again when the slave is received again and the spike is over.
    if (lab.now_s() > kSpike_s + kSpikeLength_s + 5.0 && m.state != SafetyState::kEngaged && i % 1000 == 0)
      lab.requests().engage = true;
    lab.step();
    s.watch(lab);
    if (i % 50 == 0) {
      trace.row({lab.now_s(), m.spring_force_n.norm(), lab.arm().true_wrench().force.norm(),
                 m.stiffness_n_per_m, m.port_energy_j, static_cast<double>(m.state)});
    }
    if (run.progress && i % 1000 == 0) run.progress(static_cast<double>(i) / static_cast<double>(ticks));
  }
  trace.close();
  if (run.progress) run.progress(1.0);
  return {{"duration_s", lab.now_s(), "s"},
          {"force_when_it_began_n", s.in_contact_n, "N"},
          {"held_after_s", s.held_s, "s"},
          {"stiffness_left_after_time_constant", s.stiffness_later / std::max(s.stiffness_at_hold, 1e-9), ""},
          {"force_rise_max_n", s.rise_max_n, "N"},
          {"force_two_seconds_later_n", s.residual_n, "N"},
          {"engagements", static_cast<double>(s.engagements), ""},
          {"pressed_again", s.pressed_again ? 1.0 : 0.0, ""},
          {"port_energy_min_j", m.port_energy_min_j, "J"},
          {"energy_drawdown_j", m.energy_drawdown_j, "J"}};
}

}  // namespace longreach
