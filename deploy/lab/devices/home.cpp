// Figures 9, 10 and 17 of Liu et al. 2019: a released handle returns home on a spring.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/devices/handle_behaviour.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr double kPerPaperDamping = 1e-3 * 60.0 / (2.0 * std::numbers::pi);  // N mm/(r/min) in N m s/rad
constexpr double kPerPaperStiffness = 1e-3 * 180.0 / std::numbers::pi;       // N mm/deg in N m/rad
constexpr std::array kDampings = {0.5, 0.8, 1.2, 1.6};                       // of the paper
constexpr std::array kStiffnesses = {2.0, 4.0, 8.0, 16.0};                   // about the paper's 8
constexpr double kRelease_rad = 10.0 * std::numbers::pi / 180.0;
constexpr double kRelease_m = 0.005;
constexpr double kShown_s = 0.5;
constexpr double kBand = 0.02;  // settled within this fraction of the initial displacement

/// x'' + 2 ζ ω x' + ω² x = 0 from rest at 1.
struct SecondOrder {
  double omega = 0.0, zeta = 0.0;

  [[nodiscard]] double at(double t) const {
    if (std::abs(zeta - 1.0) < 1e-9) return std::exp(-omega * t) * (1.0 + omega * t);
    if (zeta < 1.0) {
      const double wd = omega * std::sqrt(1.0 - zeta * zeta);
      return std::exp(-zeta * omega * t) * (std::cos(wd * t) + zeta * omega / wd * std::sin(wd * t));
    }
    const double root = omega * std::sqrt(zeta * zeta - 1.0);
    return std::exp(-zeta * omega * t) * (std::cosh(root * t) + zeta * omega / root * std::sinh(root * t));
  }
};

/// Last time outside the band, and the overshoot beyond home, of samples that start at 1.
struct Settling {
  double time_s = 0.0;
  double overshoot = 0.0;

  void add(double t, double x) {
    if (std::abs(x) > kBand) time_s = t;
    overshoot = std::max(overshoot, -x);
  }
};

Settling settling_of(const SecondOrder& system, double until_s) {
  Settling s;
  for (double t = 0.0; t < until_s; t += 1e-5) s.add(t, system.at(t));
  return s;
}

struct Springs {
  double stiffness = 0.0;  // N m/rad, or N/m
  double damping = 0.0;
};

/// No friction, ideal encoders and motors, fast loop and unfiltered velocity, as assumed by the closed form.
DeviceConfig closed_form_device(DeviceConfig device) {
  for (DriveConfig* drive : {&device.delta.drive, &device.spherical.drive}) {
    drive->viscous_nm_s_per_rad = drive->coulomb_nm = drive->resolution_rad = drive->bandwidth_hz = 0.0;
  }
  device.velocity_filter_s = 0.0;
  return device;
}

/// The simplest form of the home function: the anchor is at home from the start.
DeviceConfig with_home(DeviceConfig device, const Springs& linear, const Springs& angular) {
  BehaviourConfig& b = device.behaviour;
  b.idle = IdleRule::kHome;
  b.home_n_per_m = linear.stiffness;
  b.home_n_s_per_m = linear.damping;
  b.home_nm_per_rad = angular.stiffness;
  b.home_nm_s_per_rad = angular.damping;
  b.home_speed_m_per_s = b.home_speed_rad_per_s = 1e6;
  return device;
}

struct Release {
  DeviceConfig device;
  double rate_hz = 1000.0;
  Pose from{};
};

/// Releases the handle and calls `sample(t, devices)` in each sample.
template <class Sample>
void let_go(const Release& release, double until_s, const Sample& sample) {
  SimulatedDevices devices(release.device);
  devices.place(release.from);
  devices.set_target({.grip = Grip::kReleased});
  HandleBehaviour behaviour(release.device);
  const double dt_s = 1.0 / release.rate_hz;
  const auto ticks = static_cast<std::int64_t>(until_s * release.rate_hz);
  for (std::int64_t i = 0; i <= ticks; ++i) {
    const HandleState handle = devices.read(Time{} + from_seconds(static_cast<double>(i) * dt_s));
    sample(static_cast<double>(i) * dt_s, devices);
    devices.write(behaviour.step(handle, dt_s));
  }
}

/// Rotation about x as a fraction of the initial rotation.
double rotation_left(const SimulatedDevices& devices) {
  return log_rotation(devices.spherical().orientation()).x() / kRelease_rad;
}

Release rotation(const DeviceConfig& device, const Springs& springs, double rate_hz) {
  return {with_home(device, {}, springs), rate_hz, {Vector3::Zero(), exp_rotation({kRelease_rad, 0.0, 0.0})}};
}

/// One curve per column, sampled at 1 kHz.
using Table = std::vector<std::vector<double>>;

Settling run_rotation(const Release& release, std::vector<double>& curve) {
  Settling settling;
  const int every = static_cast<int>(std::lround(release.rate_hz / 1000.0));
  int i = 0;
  let_go(release, 1.5, [&](double t, const SimulatedDevices& devices) {
    settling.add(t, rotation_left(devices));
    if (i++ % every == 0 && t <= kShown_s) curve.push_back(10.0 * rotation_left(devices));
  });
  return settling;
}

std::string text(double value) {
  std::string s = std::to_string(value);
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s;
}

void write_table(const ExperimentRun& run, const char* name, std::initializer_list<std::string_view> columns,
                 const Table& table) {
  Trace trace(run.out, name, columns);
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    std::array<double, 9> v{};
    for (std::size_t c = 0; c < table.size(); ++c) v[c] = table[c][i];
    if (table.size() == 8) {
      trace.row({1e-3 * static_cast<double>(i), v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
    } else {
      trace.row({1e-3 * static_cast<double>(i), v[0], v[1], v[2], v[3]});
    }
  }
  trace.close();
}

}  // namespace

std::vector<Plot> home_rotation_plots() {
  const auto curves = [](const std::string& prefix) {
    std::vector<Curve> all;
    for (const double b : kDampings) all.push_back({prefix + text(b), text(b) + " N mm/(r/min)"});
    return all;
  };
  std::vector<Curve> stiff;
  for (const double k : kStiffnesses) stiff.push_back({"stiffness_" + text(k), text(k) + " N mm/deg"});
  return {{.name = "home-rotation",
           .csv = "damping",
           .title = "Return of the rotational handle to its home position after release at 10 degrees",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"without friction (deg)", curves("ideal_"), ""},
                      {"real device (deg)", curves("real_"), ""}}},
          {.name = "home-rotation-stiffness",
           .csv = "stiffness",
           .title = "Return to the home position at four stiffnesses (damping 0.8 N mm/(r/min), real device)",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"rotation (deg)", stiff, ""}}}};
}

std::vector<Metric> run_home_rotation(const ExperimentRun& run) {
  const DeviceConfig device = to_struct(run.config.master()).device;
  const DeviceConfig ideal = closed_form_device(device);
  const SphericalDynamics dynamics(ideal.spherical);
  const double inertia = dynamics.inertia_kg_m2(dynamics.attitude(Quaternion::Identity()))(0, 0);
  std::vector<Metric> metrics{{"inertia_kg_m2", inertia, "kg m^2"}};
  Table table(8), stiffness_table(4);
  double worst = 0.0;
  const double k = 8.0 * kPerPaperStiffness;
  for (std::size_t i = 0; i < kDampings.size(); ++i) {
    const Springs springs{k, kDampings[i] * kPerPaperDamping};
    const SecondOrder closed{std::sqrt(k / inertia), 0.5 * springs.damping / std::sqrt(k * inertia)};
    const Settling theory = settling_of(closed, 1.5);
    const Settling seen = run_rotation(rotation(ideal, springs, 8000.0), table[i]);
    const Settling real = run_rotation(rotation(device, springs, 1000.0), table[4 + i]);
    const std::string at = "_at_" + text(kDampings[i]);
    metrics.push_back({"zeta" + at, closed.zeta, ""});
    metrics.push_back({"overshoot" + at, seen.overshoot, ""});
    metrics.push_back({"settling" + at, seen.time_s, "s"});
    metrics.push_back({"settling_closed_form" + at, theory.time_s, "s"});
    metrics.push_back({"settling_real_device" + at, real.time_s, "s"});
    worst = std::max(worst, std::abs(seen.time_s / theory.time_s - 1.0));
    if (run.progress) run.progress(0.2 * static_cast<double>(i + 1));
  }
  metrics.push_back({"settling_difference_max", worst, ""});
  for (std::size_t i = 0; i < kStiffnesses.size(); ++i) {
    const Springs springs{kStiffnesses[i] * kPerPaperStiffness, 0.8 * kPerPaperDamping};
    const Settling real = run_rotation(rotation(device, springs, 1000.0), stiffness_table[i]);
    metrics.push_back({"settling_at_stiffness_" + text(kStiffnesses[i]), real.time_s, "s"});
  }
  write_table(run, "damping",
              {"t_s", "ideal_0.5", "ideal_0.8", "ideal_1.2", "ideal_1.6", "real_0.5", "real_0.8", "real_1.2",
               "real_1.6"},
              table);
  write_table(run, "stiffness", {"t_s", "stiffness_2", "stiffness_4", "stiffness_8", "stiffness_16"},
              stiffness_table);
  if (run.progress) run.progress(1.0);
  return metrics;
}

std::vector<Plot> home_translation_plots() {
  return {
      {.name = "home-translation",
       .csv = "home",
       .title = "Return of the translational handle to its home position after release at (20, -15, "
                "10) mm",
       .x_column = "t_s",
       .x_label = "time (s)",
       .panels = {
           {"spring anchored at home (mm)", {{"x_m", "x", 1e3}, {"y_m", "y", 1e3}, {"z_m", "z", 1e3}}, ""},
           {"spring with a moving anchor (mm)",
            {{"glide_x_m", "x", 1e3}, {"glide_y_m", "y", 1e3}, {"glide_z_m", "z", 1e3}},
            ""}}}};
}

std::vector<Metric> run_home_translation(const ExperimentRun& run) {
  const DeviceConfig device = to_struct(run.config.master()).device;
  std::vector<Metric> metrics;

  // Comparison with the closed form: small motion along x without friction.
  const DeviceConfig ideal = closed_form_device(device);
  const DeltaDynamics dynamics(ideal.delta);
  const double mass = dynamics.mass_kg(dynamics.pose(dynamics.home_m()))(0, 0), k = 200.0;
  double worst = 0.0;
  for (const double zeta : {0.3, 1.0}) {
    const SecondOrder closed{std::sqrt(k / mass), zeta};
    const Springs springs{k, 2.0 * zeta * std::sqrt(k * mass)};
    Settling seen;
    let_go(
        {with_home(ideal, springs, {}), 8000.0, {{kRelease_m, 0.0, 0.0}, Quaternion::Identity()}}, 2.0,
        [&](double t, const SimulatedDevices& d) { seen.add(t, d.delta().position_m().x() / kRelease_m); });
    const Settling theory = settling_of(closed, 2.0);
    const std::string at = "_at_zeta_" + text(zeta);
    metrics.push_back({"overshoot" + at, seen.overshoot, ""});
    metrics.push_back({"settling" + at, seen.time_s, "s"});
    metrics.push_back({"settling_closed_form" + at, theory.time_s, "s"});
    worst = std::max(worst, std::abs(seen.time_s / theory.time_s - 1.0));
  }
  metrics.push_back({"settling_difference_max", worst, ""});
  if (run.progress) run.progress(0.5);

  // The real device: on a spring, and gliding as by default.
  const Pose from{{0.020, -0.015, 0.010}, Quaternion::Identity()};
  std::vector<Vector3> sprung, gliding;
  let_go({with_home(device, {k, 4.0}, {}), 1000.0, from}, 2.0,
         [&](double, const SimulatedDevices& d) { sprung.push_back(d.delta().position_m()); });
  let_go({device, 1000.0, from}, 2.0,
         [&](double, const SimulatedDevices& d) { gliding.push_back(d.delta().position_m()); });
  Trace trace(run.out, "home", {"t_s", "x_m", "y_m", "z_m", "glide_x_m", "glide_y_m", "glide_z_m"});
  for (std::size_t i = 0; i < sprung.size(); ++i) {
    trace.row({1e-3 * static_cast<double>(i), sprung[i].x(), sprung[i].y(), sprung[i].z(), gliding[i].x(),
               gliding[i].y(), gliding[i].z()});
  }
  trace.close();
  metrics.push_back({"left_on_spring", sprung.back().norm(), "m"});
  metrics.push_back({"left_gliding", gliding.back().norm(), "m"});
  if (run.progress) run.progress(1.0);
  return metrics;
}

}  // namespace longreach
