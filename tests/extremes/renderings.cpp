// What the hand feels: a master with a simulated device and hand, given the same report again and again.

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/config/config.hpp"
#include "common/core/regression.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/master_node.hpp"
#include "master/simulation/simulated_devices.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kSoft_n_per_m = 1.0;  // what is softer is compared with this
constexpr double kKnown_s = 1.0;       // the surface has been met
constexpr double kRun_s = 3.0;
constexpr double kHandshake_s = 0.1;
constexpr double kTenYears_s = 10.0 * 365.25 * 86400.0;

struct Feeling {
  double stiffness_n_per_m = 1000.0;  // of the reports
  double touch_sequence = 10.0;
  std::uint64_t first_report = 1;
  double start_s = 1.0;   // on the master's clock
  double handle_m = 0.0;  // where the device says that it is, if not zero
  Grip grip = Grip::kLight;
  double reported = 1.0;  // of the stiffness that the result is judged by; others in controls
  std::vector<std::string> settings{};
};

MasterConfig master_of(const Feeling& what) {
  proto::LabConfig lab = configure(what.settings, find_deploy_folder());
  MasterConfig config = to_struct(lab.master());
  config.safety.engage_at_start = true;
  if (what.grip == Grip::kReleased) config.device.delay_samples = 1;
  return config;
}

/// To and fro through the wall; a hand that lets go does so on its way.
HandTarget motion(double t, Grip grip) {
  HandTarget target;
  target.position_m = {0.02 * std::sin(3.0 * t), 0.01 * std::sin(2.0 * t), 0.0};
  target.velocity_m_per_s = {0.06 * std::cos(3.0 * t), 0.02 * std::cos(2.0 * t), 0.0};
  target.grip = grip == Grip::kReleased && std::fmod(t, 1.5) < 0.75 ? Grip::kLight : grip;
  return target;
}

Received<StiffnessReport> report_of(const Feeling& what, const MasterView& view, std::uint64_t number) {
  StiffnessReport report{.engagement = view.engagement, .state = SafetyState::kEngaged};
  report.translation.surfaces[0] = {.normal = -Vector3::UnitX(),
                                    .stiffness = what.stiffness_n_per_m,
                                    .touch_sequence = what.touch_sequence,
                                    .touch = 1,
                                    .pressed = true};
  return {.sequence = number, .newest = true, .message = report};
}

/// Of the force over the depth of the handle, from the second touch on, against what is due: the stiffness of
/// the report or the most that the device can render.
class Felt {
 public:
  void add(const MasterView& view) {
    peak_n_ = std::max(peak_n_, view.spring_force_n.norm());
    const double depth_m = view.inward.dot(view.p_MH) - view.surface_m;
    if (view.surface_known && depth_m > 0.0 && !view.force_clamped)
      line_.add(depth_m, view.spring_force_n.dot(-view.inward));
  }
  [[nodiscard]] double peak_n() const { return peak_n_; }
  [[nodiscard]] bool valid() const { return line_.valid(); }
  [[nodiscard]] double error(double due_n_per_m) const {
    return std::abs(line_.slope() - due_n_per_m) / std::max(due_n_per_m, kSoft_n_per_m);
  }

 private:
  LineFit line_;
  double peak_n_ = 0.0;
};

ExtremeResult feel(const Feeling& what) {
  const MasterConfig config = master_of(what);
  SimulatedDevices devices(config.device);
  MasterNode node(config);
  const double period_s = 1.0 / config.loop.rate_hz;
  std::uint64_t number = what.first_report;
  Felt felt;
  for (int i = 0; period_s * i < kRun_s; ++i) {
    const double t = period_s * i;
    const Time now = Time{} + from_seconds(what.start_s) + from_seconds(t);
    devices.set_target(motion(t, what.grip));
    MasterInput in{{.now = now, .handle = devices.read(now), .last_heard = now}};
    in.handle.held = true;  // a device that cannot tell: everything is rendered on
    // Nobody leaps that far: what is small is there from the start.
    if (what.handle_m != 0.0 && (t > 1.0 || what.handle_m < 1.0)) in.handle.p_MH.x() = what.handle_m;
    Feeling quiet = what;
    if (t < kHandshake_s) quiet.stiffness_n_per_m = 0.0, quiet.touch_sequence = 0.0;
    const auto report = report_of(quiet, node.view(), number);
    if (i % 5 == 0) in.reports = {&report, 1}, number += number == UINT64_MAX ? 0 : 1;
    const MasterOutput out = node.step(in);
    devices.write(out.F_H_M);
    if (t > kKnown_s) felt.add(node.view());
    if (!out.F_H_M.force.allFinite() || !out.F_H_M.moment.allFinite())
      return bad("a wrench that is not finite");
    if (out.F_H_M.force.norm() > config.rendering.force_max_n + 1e-9) return bad("a force above its limit");
    if (!node.view().goal_m.allFinite()) return bad("a goal that is not finite");
  }
  const MasterView& view = node.view();
  if (!(view.port_energy_min_j >= -(RenderingConfig{}.store_j + kEnergy_j)))
    return bad(format_number(view.port_energy_min_j) + " J out of the device");
  if (view.state == SafetyState::kFault) return refused("the device is at fault, the hand is free");
  if (view.state != SafetyState::kEngaged) return bad("the engagement ended");
  if (view.rejected_values > 0) return refused("the reports are ignored and counted as rejected values");
  if (!(view.energy_drawdown_j <= kDrawdown_j))
    return bad(format_number(view.energy_drawdown_j) + " J out of the rendering");
  if (what.handle_m != 0.0) return accurate(felt.peak_n(), kTouch_n);
  if (!felt.valid() && what.stiffness_n_per_m > 0.0) return bad("the wall is not touched");
  return accurate(felt.error(what.reported * std::min(what.stiffness_n_per_m, view.stiffness_max_n_per_m)),
                  kNoticed);
}

using Set = std::function<void(Feeling&, double)>;
using Cells = std::initializer_list<std::pair<double, const char*>>;  // value, and what it is refused with

ExtremeRow row(const std::string& quantity, const std::string& unit, Cells cells, const Set& set) {
  const auto softer = [set](std::uint64_t) {
    Feeling what{.reported = 1.2};
    set(what, 1e3);
    what.stiffness_n_per_m = 1e3;
    return feel(what);
  };
  ExtremeRow row{
      "rendering: " + quantity, "error of the felt stiffness", {"judged by 1.2 of it", "", softer}, {}};
  for (const auto& [value, refusal] : cells) {
    row.cells.push_back({short_text(value) + unit, refusal, [set, value = value](std::uint64_t) {
                           Feeling what;
                           set(what, value);
                           return feel(what);
                         }});
  }
  return row;
}

}  // namespace

std::vector<ExtremeRow> extreme_renderings() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double denormal = std::numeric_limits<double>::denorm_min();
  std::vector<ExtremeRow> rows;
  for (const Grip grip : {Grip::kLight, Grip::kFirm, Grip::kReleased}) {
    const std::string hand = grip == Grip::kLight  ? "light hand"
                             : grip == Grip::kFirm ? "firm hand"
                                                   : "let go";
    rows.push_back(
        row("stiffness, " + hand, "",
            {{0.0, ""}, {denormal, ""}, {1e0, ""}, {1e3, ""}, {1e6, ""}, {1e9, ""}, {1e12, ""}, {1e300, ""}},
            [grip](Feeling& what, double k) {
              what.stiffness_n_per_m = k;
              what.grip = grip;
            }));
  }
  constexpr const char* kRejected = "counted as rejected values";
  constexpr const char* kFault = "the device is at fault";
  constexpr const char* kRate = "outside 250 to 8000";
  rows.push_back(row("stiffness that is none", "",
                     {{-1.0, kRejected}, {-1e9, kRejected}, {nan, kRejected}, {inf, kRejected}},
                     [](Feeling& what, double k) { what.stiffness_n_per_m = k; }));
  rows.back().control = {"one that is", kRejected, [](std::uint64_t) { return feel({}); }};
  rows.push_back(row("sequence of the touch", "",
                     {{-1.0, kRejected}, {0.0, ""}, {1e300, kRejected}, {nan, kRejected}},
                     [](Feeling& what, double sequence) { what.touch_sequence = sequence; }));
  rows.back().control = {"10, refused", kRejected, [](std::uint64_t) { return feel({}); }};
  rows.push_back(row("handle", " m",
                     {{denormal, ""}, {20.0, kFault}, {1e300, kFault}, {nan, kFault}, {inf, kFault}},
                     [](Feeling& what, double x_m) { what.handle_m = x_m; }));
  rows.back().measure = "N felt at the surface";
  rows.back().control = {"as the device says", kFault, [](std::uint64_t) { return feel({}); }};
  const auto rate = [](double period_s) {
    return "loop.rate_hz=" + format_number(std::round(1.0 / period_s));
  };
  rows.push_back(row("sample time", " s",
                     {{2e-5, kRate}, {1.25e-4, ""}, {1e-3, ""}, {4e-3, ""}, {5e-2, kRate}},
                     [rate](Feeling& what, double period_s) {
                       if (period_s < 1.0) what.settings = {rate(period_s)};
                     }));
  ExtremeRow late = row("start of the clock, number of a report", "", {}, [](Feeling&, double) {});
  late.cells.push_back({"10 years", "", [](std::uint64_t) { return feel({.start_s = kTenYears_s}); }});
  late.cells.push_back(
      {"2^64-20", "", [](std::uint64_t) { return feel({.first_report = UINT64_MAX - 19}); }});
  rows.push_back(late);
  return rows;
}

}  // namespace longreach
