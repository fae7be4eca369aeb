// The whole loop in the laboratory, as the experiment `touch` runs it: a person approaches, touches, presses
// and probes a wall across the link.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "common/config/config.hpp"
#include "common/config/number_text.hpp"
#include "slave/command/guard_config.hpp"
#include "tests/experiments/experiment.hpp"
#include "tests/experiments/extremes/extremes.hpp"
#include "tests/experiments/laboratory.hpp"

namespace longreach {
namespace {

constexpr double kEnergy_j = 1e-6;  // that may come out of the device: rounding
constexpr double kDrawdown_j = 1e-3;
constexpr double kHand_m_per_s = 1.0;
constexpr double kNoticed = 0.05;           // differences of stiffness below are not felt
constexpr double kTouch_n = 0.3;            // sensing.touch_n
constexpr double kDevice_n_per_m = 6000.0;  // that the default device can render at least

using Settings = std::vector<std::string>;

/// The figures of a run that holds together; else what is wrong with it.
ExtremeResult touch(const Settings& settings, std::uint64_t seed, std::map<std::string, double>& figures) {
  ExperimentRun run;
  run.config = configure(settings, find_deploy_folder());
  run.seed = seed;
  for (const Metric& m : run_touch(run)) {
    if (!std::isfinite(m.value)) return bad(m.name + " is not finite");
    figures[m.name] = m.value;
  }
  if (figures["port_energy_min_j"] < -(RenderingConfig{}.store_j + kEnergy_j))
    return bad(format_number(figures["port_energy_min_j"]) + " J out of the device");
  if (figures["energy_drawdown_j"] > kDrawdown_j)
    return bad(format_number(figures["energy_drawdown_j"]) + " J out of the rendering");
  if (figures["limit_violations"] > 0.0) return bad("limits of the robot are exceeded");
  if (figures["hand_speed_peak_m_per_s"] > kHand_m_per_s) return bad("the hand is thrown");
  return accurate(figures["energy_drawdown_j"], kDrawdown_j);
}

ExtremeCell cell(const std::string& name, const Settings& settings) {
  return {name, [settings](std::uint64_t seed) {
            std::map<std::string, double> figures;
            return touch(settings, seed, figures);
          }};
}

/// The run goes to its end, and the wall feels as stiff as it is times `scale`.
ExtremeCell displayed(const std::string& name, const Settings& settings, double scale = 1.0) {
  return {name, [=](std::uint64_t seed) {
            std::map<std::string, double> figures;
            const ExtremeResult result = touch(settings, seed, figures);
            if (result.outcome == ExtremeOutcome::kBad) return result;
            if (figures["probing_cycles_done"] < 1.0) return bad("the wall was not probed");
            const double wanted = scale * figures["reference_stiffness_n_per_m"];
            return accurate(std::abs(figures["displayed_stiffness_n_per_m"] / wanted - 1.0), kNoticed);
          }};
}

/// What is rendered is what the material has where it is touched, or the most that the device can render.
ExtremeCell wall(const std::string& n, const std::string& k) {
  const Settings settings = {"profile=lab", "estimator.exponent=" + n, "scene.material.wall.exponent=" + n,
                             "scene.material.wall.stiffness_n_per_m=" + k};
  return {
      k, [settings](std::uint64_t seed) {
        std::map<std::string, double> figures;
        const ExtremeResult result = touch(settings, seed, figures);
        if (result.outcome == ExtremeOutcome::kBad) return result;
        const double force_n = figures["tool_force_peak_n"], rendered = figures["rendered_stiffness_n_per_m"];
        if (force_n < kTouch_n)
          return refused(format_number(force_n) + " N are below sensing.touch_n: not felt");
        if (figures["sensor_faulted"] > 0.0)
          return refused("the force leaps as no surface lets it: taken for a fault of the sensor");
        if (figures["probing_cycles_done"] < 1.0) return bad("the wall was not probed");
        // A wall that is stiffer than the device can render feels as stiff as what is rendered.
        const bool limited = rendered >= kDevice_n_per_m && figures["reference_stiffness_n_per_m"] > rendered;
        return accurate(limited ? std::abs(figures["displayed_stiffness_n_per_m"] / rendered - 1.0)
                                : figures["rendered_stiffness_error"],
                        kNoticed);
      }};
}

/// A link so long that the script would take hours: until the touch has been known for a while.
ExtremeCell far(const std::string& name, const Settings& settings) {
  return {name, [settings](std::uint64_t seed) {
            constexpr double kUntil_s = 600.0;
            const proto::LabConfig config = configure(settings, find_deploy_folder());
            Laboratory lab(to_struct(config.master()), to_struct(config.slave()), seed);
            double spring_n = 0.0;
            while (lab.now_s() < kUntil_s) {
              lab.step();
              if (!lab.master().F_H_M.force.allFinite()) return bad("a wrench that is not finite");
              spring_n = std::max(spring_n, lab.master().spring_force_n.norm());
            }
            const MasterView& master = lab.master();
            if (master.port_energy_min_j < -(RenderingConfig{}.store_j + kEnergy_j))
              return bad("energy out of the device");
            if (master.state != SafetyState::kEngaged)
              return refused("never engaged: all news of the master is older than safety.age_max_s");
            if (spring_n == 0.0 && master.rejected_values > 0)
              return refused("not felt: the touch is older than the goals that the master remembers (60 s)");
            return spring_n > 0.0 ? accurate(master.energy_drawdown_j, kDrawdown_j)
                                  : bad("the wall is not felt");
          }};
}

/// Peak of the force at the tool. Up to the stiffest wall that the guard reckons with it is bounded; stiffer
/// ones are not promised anything, and the number shows it.
ExtremeCell guarded(const std::string& k, const Settings& more = {}) {
  Settings settings = {"profile=lab", "scene.material.wall.stiffness_n_per_m=" + k};
  settings.insert(settings.end(), more.begin(), more.end());
  return {k, [settings](std::uint64_t seed) {
            std::map<std::string, double> figures;
            const ExtremeResult result = touch(settings, seed, figures);
            if (result.outcome == ExtremeOutcome::kBad) return result;
            const proto::SlaveConfig slave = configure(settings, find_deploy_folder()).slave();
            const double over = figures["tool_force_peak_n"] / slave.command().force_guard_n();
            const double wall_n_per_m = slave.scene().material(0).stiffness_n_per_m();
            const bool reckoned = wall_n_per_m <= slave.command().guard_stiffness_n_per_m();
            return accurate(over, reckoned ? kGuardOvershoot : std::numeric_limits<double>::max());
          }};
}

}  // namespace

std::vector<ExtremeRow> extreme_whole_loops() {
  std::vector<ExtremeRow> rows;
  const auto row = [&rows](const std::string& quantity, const std::string& measure) -> ExtremeRow& {
    rows.push_back({"whole loop: " + quantity, measure, {}});
    return rows.back();
  };
  for (const char* n : {"1", "3"}) {
    ExtremeRow& walls = row(std::string("stiffness of the wall, n = ") + n,
                            "error of what is rendered, up to the device's limit");
    for (const char* k : {"1", "1e2", "1e4", "1e6", "1e9"}) walls.cells.push_back(wall(n, k));
  }
  ExtremeRow& guard = row("force at the tool", "peak / guard; above 2e4 N/m not promised");
  for (const char* k : {"1", "1e2", "5e3", "2e4", "1e6", "1e9"}) guard.cells.push_back(guarded(k));
  ExtremeRow& damping = row("damping of the wall λ/k", "J out of the rendering");
  for (const char* a : {"0", "1", "100"})
    damping.cells.push_back(cell(std::string(a) + " s/m",
                                 {std::string("scene.material.wall.damping_s_per_m=") + a, "profile=lab"}));
  const auto delays = [](const std::string& s) {
    return Settings{"master.link.impairment.delay_s=" + s, "slave.link.impairment.delay_s=" + s};
  };
  ExtremeRow& delay = row("delay each way", "error of the displayed stiffness");
  for (const char* s : {"0", "0.1", "1", "10"}) {
    Settings settings = delays(s);
    settings.push_back("duration_s=" + format_number(120.0 + 60.0 * std::atof(s)));
    delay.cells.push_back(displayed(std::string(s) + " s", settings));
  }
  delay.cells.push_back(cell("101 s", delays("101")));
  // Whatever is older than 30 s is no news to the slave, unless it is told so. 100 commands a second, since
  // no more than 16384 are under way in an artificial impairment.
  ExtremeRow& longest = row("longer delays (told: age_max_s = 1000)", "J out of the rendering");
  for (const char* s : {"20", "100"}) {
    Settings settings = delays(s);
    settings.emplace_back("link.send_hz=100");
    longest.cells.push_back(far(s + std::string(" s"), settings));
    settings.emplace_back("slave.safety.age_max_s=1000");
    longest.cells.push_back(far(s + std::string(" s, told"), settings));
  }
  ExtremeRow& period = row("sample time", "error of the displayed stiffness");
  for (const char* hz : {"50000", "8000", "1000", "250", "20"})
    period.cells.push_back(displayed(short_text(1.0 / std::atof(hz)) + " s",
                                     {std::string("loop.rate_hz=") + hz, "profile=lab"}));
  // A wall that is near, since the handle has little way at a fine scale.
  ExtremeRow& scale = row("scale, force scaled alike", "error of the displayed stiffness");
  for (const char* s : {"0.001", "0.05", "0.2", "1"})
    scale.cells.push_back(
        displayed(s,
                  {std::string("mapping.scale=") + s, "profile=lab", "rendering.ke_by_scale=true",
                   "scene.surface.wall.plane.point_m=0.101,0,0"},
                  std::atof(s)));
  ExtremeRow& load = row("mass at the force sensor", "error of the displayed stiffness");
  for (const char* kg : {"1e-3", "10", "1e5"})
    load.cells.push_back(
        displayed(std::string(kg) + " kg", {std::string("sensing.tool.mass_kg=") + kg, "profile=lab"}));
  return rows;
}

}  // namespace longreach
