// Pressing on a wall in rate mode. There is no position to press against: the deflection of the handle beyond its dead
// zone commands a force, and the goal is as deep in the wall as this force requires. As a control, the deflection
// commands the speed of the goal, and the force at the tool then depends on what has happened before.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

constexpr double kTowards_m = 0.04;  // deflection of the hand: 70 mm/s with the defaults
constexpr double kNear_m = 0.012;    // 14 mm/s
constexpr double kWallAt_m = 0.15;
// Deflections at which the hand rests in contact, m; the dead zone ends at 5 mm.
constexpr std::array kHeld_m = {0.04, 0.02, 0.014, 0.011, 0.008};
constexpr double kRest_s = 6.0, kJudged_s = 2.0;

/// Moves towards the wall, rests at each deflection in turn while the tool presses, and retreats.
class RatePerson {
 public:
  explicit RatePerson(double centring_n_per_m) : centring_n_per_m_(centring_n_per_m) {}
  HandTarget step(const MasterView& m, double t) {
    // The centre of rate mode is the position of the handle at its start.
    if (m.state != SafetyState::kEngaged) {
      began_s_ = t;
      return {};
    }
    if (at_ < 0 && m.stiffness_n_per_m > 1.0) at_ = 0, began_s_ = t;
    if (at_ >= 0 && since(t) > kRest_s) ++at_, began_s_ = t;
    const auto i = static_cast<std::size_t>(std::max(0, at_));
    double deflection = m.goal_m.x() < 0.8 * kWallAt_m ? kTowards_m : kNear_m;
    if (at_ >= 0) deflection = i < kHeld_m.size() ? kHeld_m[i] : -kTowards_m;
    // A compliant hand must aim beyond the intended deflection.
    HandTarget target;
    target.grip = Grip::kFirm;
    const double against_n = centring_n_per_m_ * deflection + m.spring_force_n.norm();
    target.position_m.x() = deflection + against_n / hand_model(Grip::kFirm).stiffness_n_per_m;
    return target;
  }
  [[nodiscard]] bool judged(double t) const {
    return at_ >= 0 && !leaves() && since(t) > kRest_s - kJudged_s;
  }
  [[nodiscard]] bool leaves() const { return at_ >= static_cast<int>(kHeld_m.size()); }
  [[nodiscard]] bool done() const { return at_ > static_cast<int>(kHeld_m.size()); }
  [[nodiscard]] std::size_t held() const { return static_cast<std::size_t>(at_); }

 private:
  [[nodiscard]] double since(double t) const { return t - began_s_; }
  double centring_n_per_m_;
  int at_ = -1;  // -1: on the way
  double began_s_ = 0.0;
};

/// Mean forces at rest, one of each deflection.
struct Pressed {
  std::array<double, kHeld_m.size()> felt_n{}, tool_n{};
  double rise_max_n = 0.0, duration_s = 0.0;
  MasterView master{};
};

Pressed press(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed, Trace* trace) {
  Laboratory lab(master, slave, seed);
  RatePerson person(master.rendering.rate_stiffness_n_per_m);
  Pressed seen;
  double last_n = 0.0;
  std::array<int, kHeld_m.size()> samples{};
  for (int i = 0; i < 120000 && !person.done(); ++i) {
    lab.drive(person.step(lab.master(), lab.now_s()));
    lab.step();
    const MasterView& m = lab.master();
    const double felt_n = m.spring_force_n.norm(), tool_n = lab.arm().true_wrench().force.norm();
    seen.rise_max_n = std::max(seen.rise_max_n, felt_n - last_n);
    last_n = felt_n;
    if (person.judged(lab.now_s())) {
      const std::size_t at = person.held();
      ++samples[at];
      seen.felt_n[at] += (felt_n - seen.felt_n[at]) / samples[at];
      seen.tool_n[at] += (tool_n - seen.tool_n[at]) / samples[at];
    }
    if (trace != nullptr && i % 20 == 0)
      trace->row(
          {lab.now_s(), m.p_MH.x(), m.goal_m.x() - kWallAt_m, felt_n, tool_n, m.port_energy_j, m.tank_j});
  }
  seen.master = lab.master();
  seen.duration_s = lab.now_s();
  return seen;
}

/// Least and greatest ratio of the force at the hand to the force at the tool.
std::pair<double, double> ratios(const Pressed& seen) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < kHeld_m.size(); ++i) {
    const double ratio = seen.felt_n[i] / std::max(seen.tool_n[i], 1e-9);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  return {least, most};
}

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
  slave.scene.surface[0].plane = {.point_m = {kWallAt_m, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}};
  Trace trace(run.out, "rate-contact",
              {"t_s", "hand_m", "depth_m", "felt_n", "tool_n", "port_energy_j", "tank_j"});
  const Pressed seen = press(master, slave, run.seed, &trace);
  trace.close();
  master.rendering.rate_force_ratio = 0.0;
  const auto [least, most] = ratios(seen);
  const auto [control_least, control_most] = ratios(press(master, slave, run.seed, nullptr));
  const MasterView& m = seen.master;
  return {{"duration_s", seen.duration_s, "s"},
          {"felt_n", *std::ranges::max_element(seen.felt_n), "N"},
          {"tool_force_n", *std::ranges::max_element(seen.tool_n), "N"},
          {"ratio_min", least, ""},
          {"ratio_max", most, ""},
          {"ratio_spread", most / std::max(least, 1e-9), ""},
          {"control_spread", control_most / std::max(control_least, 1e-9), ""},
          {"force_rise_max_n", seen.rise_max_n, "N"},
          {"left", m.spring_force_n.norm() < 0.1 ? 1.0 : 0.0, ""},
          {"port_energy_min_j", m.port_energy_min_j, "J"},
          {"energy_drawdown_j", m.energy_drawdown_j, "J"}};
}

}  // namespace longreach
