#include "master/simulation/simulated_devices.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numbers>

namespace longreach {
namespace {

constexpr double kLongestStep_s = 0.05;  // avoids a jump after a stall

double least_eigenvalue(const Matrix3& symmetric) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

}  // namespace

double cell_radius(double step_rad, const Matrix3& rates) {
  const Matrix3 ways = step_rad * rates.inverse();
  double longest = 0.0;
  for (const double j : {-1.0, 1.0}) {
    for (const double k : {-1.0, 1.0}) longest = std::max(longest, (ways * Vector3(1.0, j, k)).norm());
  }
  return 0.5 * longest;
}

SimulatedDevices::SimulatedDevices(const DeviceConfig& config)
    : turns_(config.turns),
      delta_(config),
      spherical_(config),
      delta_handle_(config),
      spherical_handle_(config) {}

bool SimulatedDevices::place(const Pose& X_MH) {
  if (!delta_.place(X_MH.p) || !spherical_.place(X_MH.q)) return false;
  spherical_handle_.start_at(X_MH.q);
  return true;
}

HandleState SimulatedDevices::read(Time now) {
  const double dt_s = started_ ? std::clamp(to_seconds(now - now_), 0.0, kLongestStep_s) : 0.0;
  if (started_ && dt_s <= 0.0) return measured_;
  started_ = true;
  now_ = now;
  if (dt_s > 0.0) {
    delta_.step(dt_s, hand_model(target_.grip), target_.position_m, target_.velocity_m_per_s);
    if (turns_) spherical_.step(dt_s, wrist_model(target_.grip), target_.rotation_rad);
  }
  measured_.ok = delta_handle_.read(delta_.encoder_rad(), dt_s);
  measured_.p_MH = delta_handle_.position_m();
  measured_.velocity_m_per_s = delta_handle_.velocity_m_per_s();
  if (turns_) {
    measured_.ok = spherical_handle_.read(spherical_.encoder_rad(), dt_s) && measured_.ok;
    measured_.q_MH = spherical_handle_.orientation();
    measured_.angular_rad_per_s = spherical_handle_.angular_rad_per_s();
  }
  measured_.buttons = target_.buttons;
  measured_.held = target_.grip != Grip::kReleased;
  return measured_;
}

void SimulatedDevices::write(const Wrench& F_H_M) {
  delta_.command(delta_handle_.torques(F_H_M.force));
  if (turns_) spherical_.command(spherical_handle_.torques(F_H_M.moment));
}

DeviceFigures device_figures(const DeviceConfig& config, double period_s) {
  const SimulatedDelta delta(config);
  const SimulatedSpherical spherical(config);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  DeviceFigures least{kNone, kNone, kNone, kNone, 0.0, {}};
  for (int i = 0; i < 27; ++i) {
    const Vector3 d = Vector3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).stableNormalized();
    const DeltaPose p = delta.dynamics().pose(delta.dynamics().home_m() + config.delta.workspace_m * d);
    const SphericalAttitude q =
        spherical.dynamics().attitude(exp_rotation(config.spherical.workspace_rad * d));
    const auto damping = [](double b, const Matrix3& rates) {
      return b * least_eigenvalue(rates.transpose() * rates);
    };
    least.mass_kg = std::min(least.mass_kg, least_eigenvalue(delta.dynamics().mass_kg(p)));
    least.inertia_kg_m2 =
        std::min(least.inertia_kg_m2, least_eigenvalue(spherical.dynamics().inertia_kg_m2(q)));
    least.damping_n_s_per_m =
        std::min(least.damping_n_s_per_m, damping(config.delta.drive.viscous_nm_s_per_rad, p.rates));
    least.damping_nm_s_per_rad =
        std::min(least.damping_nm_s_per_rad, damping(config.spherical.drive.viscous_nm_s_per_rad, q.rates));
    least.cell.m = std::max(least.cell.m, cell_radius(config.delta.drive.resolution_rad, p.rates));
    least.cell.rad = std::max(least.cell.rad, cell_radius(config.spherical.drive.resolution_rad, q.rates));
  }
  const double hz = config.delta.drive.bandwidth_hz;
  least.delay_s = config.delay_samples * period_s + (hz > 0.0 ? 0.5 * std::numbers::inv_pi / hz : 0.0);
  return least;
}

}  // namespace longreach
