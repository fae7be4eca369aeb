// The stiffness law in the delay studies: both nodes in the laboratory over one link.

#include <algorithm>
#include <limits>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"
#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach {
namespace {

constexpr double kQuiet_m = 1e-4;
constexpr double kPressed_s = 2.0;  // time in the wall before the hand releases the handle

double rtt_of(const proto::LinkProfile& link) { return link.up().delay_s() + link.down().delay_s(); }

ExperimentRun across(const ExperimentRun& run, const proto::LinkProfile& link, double wall_n_per_m,
                     Grip grip) {
  ExperimentRun out;
  out.config = run.config;
  out.seed = run.seed;
  proto::MasterConfig& master = *out.config.mutable_master();
  proto::SlaveConfig& slave = *out.config.mutable_slave();
  take_profile(*master.mutable_link(), link);
  take_profile(*slave.mutable_link(), link);
  master.mutable_rendering()->set_law(proto::Rendering::STIFFNESS);
  // A hand that releases the handle is a light one before.
  master.mutable_hand()->set_grip(grip == Grip::kFirm ? proto::Hand::FIRM : proto::Hand::LIGHT);
  for (proto::Material& material : *slave.mutable_scene()->mutable_material())
    material.set_stiffness_n_per_m(wall_n_per_m);
  out.config.set_duration_s(120.0 + 30.0 * rtt_of(link));
  return out;
}

/// Presses, releases the handle, and checks for several round trips whether it comes to rest.
Pressed let_go_in_contact(const ExperimentRun& run, double rtt_s) {
  Laboratory lab(to_struct(run.config.master()), to_struct(run.config.slave()), run.seed);
  const double end_s = run.config.duration_s();
  while (lab.now_s() < end_s && lab.script().phase() != ScriptPhase::kPress) lab.step();
  const double free_s = lab.now_s() + kPressed_s + rtt_s;
  while (lab.now_s() < free_s) lab.step();
  lab.let_go();
  const double rest_s = free_s + 8.0 + 2.0 * rtt_s, done_s = rest_s + 1.0 + rtt_s;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  while (lab.now_s() < done_s) {
    lab.step();
    if (lab.now_s() < rest_s) continue;
    const double x_m = lab.master().inward.dot(lab.devices().delta().position_m());
    low_m = std::min(low_m, x_m);
    high_m = std::max(high_m, x_m);
  }
  Pressed out;
  out.motion_m = high_m - low_m;
  out.limit_cycle = out.motion_m > kQuiet_m;
  out.port_energy_min_j = lab.master().port_energy_min_j;
  out.drawdown_j = lab.master().energy_drawdown_j;
  return out;
}

}  // namespace

proto::LinkProfile plain_link(const proto::LabConfig& config, double rtt_s) {
  proto::LinkProfile link;
  *link.mutable_down() = config.master().link().impairment();
  *link.mutable_up() = config.slave().link().impairment();
  link.mutable_down()->set_delay_s(0.5 * rtt_s);
  link.mutable_up()->set_delay_s(0.5 * rtt_s);
  return link;
}

DelayResult touch_across(const ExperimentRun& run, const proto::LinkProfile& link, double wall_n_per_m,
                         Grip grip) {
  const ExperimentRun there = across(run, link, wall_n_per_m, grip);
  const double rtt_s = rtt_of(link);
  DelayResult result{RenderingLaw::kStiffness, rtt_s, wall_n_per_m, grip};
  if (grip == Grip::kReleased) {
    result.found = let_go_in_contact(there, rtt_s);
    return result;
  }
  result.error = 1.0;
  bool probed = false;
  for (const Metric& m : run_touch(there)) {
    if (m.name == "displayed_stiffness_n_per_m") result.found.displayed_n_per_m = m.value;
    if (m.name == "displayed_stiffness_error") result.error = m.value;
    if (m.name == "estimate_sd") result.estimate_sd = m.value;
    if (m.name == "port_energy_min_j") result.found.port_energy_min_j = m.value;
    if (m.name == "energy_drawdown_j") result.found.drawdown_j = m.value;
    if (m.name == "probing_cycles_done") probed = m.value > 0.0;
  }
  // A hand that oscillates neither settles nor completes its script, which shows in the fit of the slope.
  result.found.limit_cycle = !probed;
  return result;
}

}  // namespace longreach
