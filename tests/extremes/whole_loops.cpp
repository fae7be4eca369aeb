// The whole loop in the laboratory, as the experiment `touch` runs it: a person approaches, touches, presses
// and probes a wall across the link.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "slave/config/guard_config.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kHand_m_per_s = 1.0;
// From the touch to the rest of the tool, at the speed of approach: 16 ms are the lag of the default servo.
constexpr double kAtRest_s = 0.02;

using Settings = std::vector<std::string>;

using Figures = std::map<std::string, double>;

/// The figures of a run that holds together and touches something; else what is wrong with it.
std::optional<ExtremeResult> touch(const Settings& settings, std::uint64_t seed, Figures& figures) {
  ExperimentRun run;
  run.config = configure(settings, find_deploy_folder());
  run.seed = seed;
  for (const Metric& m : run_touch(run)) {
    if (!std::isfinite(m.value)) return bad(m.name + " is not finite");
    figures[m.name] = m.value;
  }
  if (figures["contact"] == 0.0) return bad("no contact");
  if (figures["port_energy_min_j"] < -(RenderingConfig{}.store_j + kEnergy_j))
    return bad(format_number(figures["port_energy_min_j"]) + " J out of the device");
  if (figures["energy_drawdown_j"] > kDrawdown_j)
    return bad(format_number(figures["energy_drawdown_j"]) + " J out of the rendering");
  if (figures["limit_violations"] > 0.0) return bad("limits of the robot are exceeded");
  if (figures["hand_speed_peak_m_per_s"] > kHand_m_per_s) return bad("the hand is thrown");
  return std::nullopt;
}

/// The run goes to its end, and the wall feels as stiff as it is, times `scale`, or as the device can render.
ExtremeResult feel(const Settings& settings, std::uint64_t seed, double scale) {
  Figures figures;
  if (const auto wrong = touch(settings, seed, figures)) return *wrong;
  if (figures["tool_force_peak_n"] < kTouch_n)
    return refused(format_number(figures["tool_force_peak_n"]) + " N are below sensing.touch_n: not felt");
  if (figures["sensor_faulted"] > 0.0)
    return refused("the force leaps as no surface lets it: taken for a fault of the sensor");
  if (figures["probing_cycles_done"] < 1.0) return bad("the wall was not probed");
  const double due =
      std::min(scale * figures["reference_stiffness_n_per_m"], figures["stiffness_max_n_per_m"]);
  return accurate(std::abs(figures["displayed_stiffness_n_per_m"] / due - 1.0), kNoticed);
}

ExtremeCell displayed(const std::string& name, const Settings& settings, double scale = 1.0,
                      const std::string& refusal = "") {
  return {name, refusal, [=](std::uint64_t seed) { return feel(settings, seed, scale); }};
}

/// The wall of another material.
ExtremeCell wall(const std::string& n, const std::string& k, const std::string& refusal) {
  // The force of a wall that is far stiffer than the guard reckons with persists, so that the robot holds after 12 s:
  // it is probed for 8 s.
  return displayed(k,
                   {"profile=lab", "operator.probe_cycles=2", "scene.material.wall.exponent=" + n,
                    "scene.material.wall.stiffness_n_per_m=" + k},
                   1.0, refusal);
}

/// A link so long that the script would take hours: until the touch has been known for a while.
ExtremeCell far(const std::string& name, const Settings& settings, const std::string& refusal) {
  return {name, refusal, [settings](std::uint64_t seed) {
            constexpr double kUntil_s = 600.0;
            const proto::LabConfig config = configure(settings, find_deploy_folder());
            Laboratory lab(to_struct(config.master()), to_struct(config.slave()), seed);
            double felt_n_per_m = 0.0, true_n_per_m = 0.0;
            while (lab.now_s() < kUntil_s) {
              lab.step();
              const MasterView& master = lab.master();
              if (!master.F_H_M.force.allFinite()) return bad("a wrench that is not finite");
              if (master.spring_force_n.norm() <= kTouch_n) continue;
              felt_n_per_m = master.stiffness_n_per_m;
              true_n_per_m = lab.arm().material_stiffness(lab.rendered_at_m());
            }
            const MasterView& master = lab.master();
            if (master.port_energy_min_j < -(RenderingConfig{}.store_j + kEnergy_j))
              return bad("energy out of the device");
            if (master.state != SafetyState::kEngaged)
              return refused("never engaged: all news of the master is older than safety.age_max_s");
            if (felt_n_per_m == 0.0 && master.rejected_values > 0)
              return refused("not felt: the touch is older than the goals that the master remembers (60 s)");
            return true_n_per_m > 0.0 ? accurate(std::abs(felt_n_per_m / true_n_per_m - 1.0), kNoticed)
                                      : bad("the wall is not felt");
          }};
}

/// Peak of the force at the tool. Up to the stiffest wall that the guard reckons with it keeps to the guard;
/// stiffer ones get what the tool goes on by until it has come to rest, and the number shows it. `told`:
/// share of the speed of approach that is reckoned with; of the control.
ExtremeCell guarded(const std::string& k, double reported = 1.0) {
  const Settings settings = {"profile=lab", "scene.material.wall.stiffness_n_per_m=" + k};
  return {k, "", [settings, reported](std::uint64_t seed) {
            Figures figures;
            if (const auto wrong = touch(settings, seed, figures)) return *wrong;
            const proto::LabConfig config = configure(settings, find_deploy_folder());
            const proto::Command& command = config.slave().command();
            const double wall_n_per_m = config.slave().scene().material(0).stiffness_n_per_m();
            const double way_m = reported * config.master().operator_().approach_speed_m_per_s() * kAtRest_s;
            const double stiffer_n =
                wall_n_per_m > command.guard_stiffness_n_per_m() ? wall_n_per_m * way_m : 0.0;
            return accurate(figures["tool_force_peak_n"] / command.force_guard_n(),
                            kGuardOvershoot + stiffer_n / command.force_guard_n());
          }};
}

constexpr const char* kError = "error of the displayed stiffness";

ExtremeRow& add(std::vector<ExtremeRow>& rows, const std::string& quantity, const std::string& measure,
                const ExtremeCell& control) {
  rows.push_back({"whole loop: " + quantity, measure, control, {}});
  return rows.back();
}

void add_walls(std::vector<ExtremeRow>& rows) {
  const ExtremeCell no_wall = displayed("no wall", {"profile=lab", "scene_file=scenes/free.txtpb"});
  for (const std::string n : {"1", "3"}) {
    ExtremeRow& walls = add(rows, "stiffness of the wall, n = " + n,
                            std::string(kError) + ", up to the device's limit", no_wall);
    for (const std::string k : {"1", "1e2", "1e4", "1e6", "1e9"})
      walls.cells.push_back(wall(n, k,
                                 k == "1" && n == "1"     ? "below sensing.touch_n"
                                 : k == "1e9" && n == "1" ? "a fault of the sensor"
                                                          : ""));
  }
  ExtremeRow& guard = add(rows, "force at the tool", "peak / guard; above 2e4 N/m more", guarded("1e6", 0.1));
  for (const char* k : {"1", "1e2", "5e3", "2e4", "1e6", "1e9"}) guard.cells.push_back(guarded(k));
  ExtremeRow& damping = add(rows, "damping of the wall λ/k", kError, no_wall);
  for (const std::string a : {"0", "1", "100"})
    damping.cells.push_back(
        displayed(a + " s/m", {"scene.material.wall.damping_s_per_m=" + a, "profile=lab"}));
}

Settings delays(const std::string& s) {
  return {"master.link.impairment.delay_s=" + s, "slave.link.impairment.delay_s=" + s};
}

void add_delays(std::vector<ExtremeRow>& rows, const ExtremeCell& softer) {
  ExtremeRow& delay = add(rows, "delay each way", kError, softer);
  for (const std::string s : {"0", "0.1", "1", "10", "101"}) {
    Settings settings = delays(s);
    settings.push_back("duration_s=" + format_number(120.0 + 60.0 * std::atof(s.c_str())));
    delay.cells.push_back(displayed(s + " s", settings, 1.0, s == "101" ? "outside 0 to 100" : ""));
  }
  // Whatever is older than 30 s is no news to the slave, unless it is told so. 100 commands a second, since
  // no more than 16384 are under way in an artificial impairment.
  ExtremeRow& longest = add(rows, "longer delays (told: age_max_s = 1000)", "error of the rendered stiffness",
                            far("1 s, no wall", {"profile=moon", "scene_file=scenes/free.txtpb"}, ""));
  for (const std::string s : {"20", "100"}) {
    Settings settings = delays(s);
    settings.emplace_back("link.send_hz=100");
    longest.cells.push_back(far(s + " s", settings, "safety.age_max_s"));
    settings.emplace_back("slave.safety.age_max_s=1000");
    longest.cells.push_back(far(s + " s, told", settings, ""));
  }
}

}  // namespace

std::vector<ExtremeRow> extreme_whole_loops() {
  const ExtremeCell softer = displayed("judged by 1.2 of it", {"profile=lab"}, 1.2);
  std::vector<ExtremeRow> rows;
  add_walls(rows);
  add_delays(rows, softer);
  ExtremeRow& period = add(rows, "sample time", kError, softer);
  for (const std::string hz : {"50000", "8000", "1000", "250", "20"})
    period.cells.push_back(displayed(short_text(1.0 / std::atof(hz.c_str())) + " s",
                                     {"loop.rate_hz=" + hz, "profile=lab"}, 1.0,
                                     hz == "50000" || hz == "20" ? "outside 250 to 8000" : ""));
  // A wall that is near, since the handle has little way at a fine scale.
  ExtremeRow& scale = add(rows, "scale, force scaled alike", kError, softer);
  for (const std::string s : {"0.001", "0.05", "0.2", "1"})
    scale.cells.push_back(displayed(s,
                                    {"mapping.scale=" + s, "profile=lab", "rendering.ke_by_scale=true",
                                     "scene.surface.wall.plane.point_m=0.101,0,0"},
                                    std::atof(s.c_str()), s == "0.001" ? "outside 0.05 to 1" : ""));
  ExtremeRow& load = add(rows, "mass at the force sensor, hanging along the wall's normal", kError, softer);
  for (const std::string kg : {"1e-3", "10", "1e5"})
    load.cells.push_back(displayed(kg + " kg",
                                   {"sensing.tool.mass_kg=" + kg, "sensing.tool.com_m=0.01,0,0.1",
                                    "sensing.gravity_m_per_s2=-9.81,0,0", "profile=lab"},
                                   1.0, kg == "1e5" ? "outside 0 to 10000" : ""));
  return rows;
}

}  // namespace longreach
