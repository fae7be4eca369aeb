// Figures 15 and 16 of Liu et al. 2019: the torques that support the translational device, at home and
// elsewhere, and its motion after the hand releases it: with compensation, without, and with real encoders
// and friction.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/devices/delta_catalog.hpp"
#include "deploy/lab/devices/wall_bench.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {
namespace {

constexpr double kHold_s = 10.0;
constexpr int kPoses = 200;

/// Torques that the paper measured, mN m, at home and at [1.5, 17.7, 33.3] mm.
struct Measured {
  const char* name;
  Vector3 at_m;
  Vector3 tau_mnm;
};
const std::array<Measured, 2> kPaper = {
    {{"home", {0.0, 0.0, 0.0}, {16.18, 16.28, 16.34}},
     {"raised", {1.5243e-3, 17.6991e-3, 33.3409e-3}, {15.62, 13.45, 18.76}}}};

void compare_with_paper(std::vector<Metric>& metrics) {
  const DeltaDesign design = reconstructed_delta();
  const DeltaKinematics kinematics(design.geometry);
  for (const Measured& m : kPaper) {
    const Vector3 p = design.home_m + m.at_m;
    const Vector3 theta = kinematics.inverse(p).theta_rad;
    const Vector3 tau = gravity_torques(design.geometry, design.masses, {0.0, 0.0, -9.81}, theta,
                                        velocity(design.geometry, theta, p))
                            .tau_nm;
    for (int i = 0; i < 3; ++i) {
      const std::string leg = std::string("_") + m.name + "_" + std::to_string(i + 1);
      metrics.push_back({"torque" + leg, 1e3 * std::abs(tau[i]), "mN m"});
      metrics.push_back({"torque_paper" + leg, m.tau_mnm[i], "mN m"});
    }
  }
}

struct Drift {
  double most_m = 0.0;   // from the point of release
  double creep_m = 0.0;  // in the last nine seconds of ten
};

/// How far the handle moves after it is released at a position, at 1 kHz.
Drift drift(const DeviceConfig& device, const Vector3& at_m, std::vector<double>* curve = nullptr) {
  SimulatedDelta mechanism(device);
  DeltaHandle handle(device);
  mechanism.place(at_m);
  Drift seen;
  Vector3 settled_m = at_m;
  for (int i = 0; i < static_cast<int>(kHold_s * 1e3); ++i) {
    handle.read(mechanism.encoder_rad(), i == 0 ? 0.0 : 1e-3);
    mechanism.command(handle.torques(Vector3::Zero()));
    mechanism.step(1e-3, {}, Vector3::Zero(), Vector3::Zero());
    const double off_m = (mechanism.position_m() - at_m).norm();
    seen.most_m = std::max(seen.most_m, off_m);
    if (i == 1000) settled_m = mechanism.position_m();
    if (curve && i % 10 == 0) curve->push_back(off_m);
  }
  seen.creep_m = (mechanism.position_m() - settled_m).norm();
  return seen;
}

DeviceConfig frictionless(DeviceConfig device) {
  const Vector3 gravity = device.gravity_m_per_s2;
  device = ideal_device(device);
  device.gravity_m_per_s2 = gravity;
  device.delta.drive.viscous_nm_s_per_rad = 0.0;
  return device;
}

}  // namespace

std::vector<Plot> gravity_plots() {
  return {{.name = "gravity",
           .csv = "drift",
           .title = "Drift of the handle after its release at (20, 20, 20) mm",
           .x_column = "t_s",
           .x_label = "time (s)",
           .panels = {{"drift (mm)",
                       {{"without_m", "without compensation", 1e3},
                        {"real_m", "compensated, real device", 1e3},
                        {"ideal_m", "compensated, ideal", 1e3}},
                       "set logscale y\nset yrange [1e-13:100]"}}}};
}

std::vector<Metric> run_gravity(const ExperimentRun& run) {
  const DeviceConfig device = to_struct(run.config.master()).device;
  const DeviceConfig ideal = frictionless(device);
  DeviceConfig without = device;
  without.gravity_compensation = false;
  std::vector<Metric> metrics;
  compare_with_paper(metrics);

  Random random = Random(run.seed).child("poses");
  double worst_ideal = 0.0, worst_real = 0.0, worst_creep = 0.0;
  for (int i = 0; i < kPoses; ++i) {
    Vector3 at_m;
    do {
      for (int k = 0; k < 3; ++k) at_m[k] = random.uniform(-1.0, 1.0);
    } while (at_m.norm() > 1.0);
    at_m *= device.delta.workspace_m;
    worst_ideal = std::max(worst_ideal, drift(ideal, at_m).most_m);
    const Drift real = drift(device, at_m);
    worst_real = std::max(worst_real, real.most_m);
    worst_creep = std::max(worst_creep, real.creep_m);
    if (run.progress) run.progress(static_cast<double>(i + 1) / kPoses);
  }
  metrics.push_back({"drift_ideal_max", worst_ideal, "m"});
  metrics.push_back({"drift_real_max", worst_real, "m"});
  metrics.push_back({"creep_real_max", worst_creep, "m"});

  std::vector<double> fallen, held, real;
  const Vector3 at_m = Vector3::Constant(0.02);
  metrics.push_back({"drift_without_compensation", drift(without, at_m, &fallen).most_m, "m"});
  drift(ideal, at_m, &held);
  drift(device, at_m, &real);
  Trace trace(run.out, "drift", {"t_s", "without_m", "ideal_m", "real_m"});
  for (std::size_t i = 0; i < fallen.size(); ++i)
    trace.row({0.01 * static_cast<double>(i), fallen[i], std::max(held[i], 1e-13), std::max(real[i], 1e-13)});
  trace.close();
  return metrics;
}

}  // namespace longreach
