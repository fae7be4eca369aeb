#include "master/simulation/simulated_delta.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace longreach {
namespace {

constexpr double kDeltaStep_s = 1e-3;
constexpr double kEdge_n_per_m = 2e4;  // rubber on metal
constexpr double kEdge_n_s_per_m = 60.0;
/// Radius that must be reachable, relative to the workspace: the edge is slightly compliant.
constexpr double kDeltaBeyond = 1.1;
constexpr double kLeastEdgeLever = 0.05;  // relative to the arm, at the edge of the workspace

/// Visits the directions of the faces, edges and corners of a cube.
template <class Visit>
void each_direction(const Visit& visit) {
  for (int i = 0; i < 27; ++i) {
    const Vector3 d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (d.squaredNorm() > 0.0) visit(Vector3(d.normalized()));
  }
}

}  // namespace

SimulatedDelta::SimulatedDelta(const DeviceConfig& config)
    : dynamics_(config.delta),
      drives_(config.delta.drive, config.delay_samples),
      gravity_(config.gravity_m_per_s2),
      workspace_m_(config.delta.workspace_m) {
  require_workspace();
  place(Vector3::Zero());
}

void SimulatedDelta::require_workspace() const {
  const double least = kLeastEdgeLever * dynamics_.geometry().arm_m();
  const auto require = [&](const Vector3& x_m, const std::string& name) {
    const DeltaPose at = dynamics_.pose(dynamics_.home_m() + x_m);
    if (at.closed && at.at.lever_m.cwiseAbs().minCoeff() > least &&
        jacobian(at.at).status == SolutionStatus::kFound)
      return;
    throw GeometryError(name);
  };
  require(Vector3::Zero(), "home_height_m: the platform cannot reach this position");
  each_direction([&](const Vector3& d) {
    require(kDeltaBeyond * workspace_m_ * d,
            "workspace_m: this distance exceeds the reach of the device in at least one direction");
  });
}

bool SimulatedDelta::place(const Vector3& x_m) {
  const DeltaPose at = dynamics_.pose(dynamics_.home_m() + x_m);
  if (!at.closed) return false;
  pose_ = at;
  v_.setZero();
  friction_nm_.setZero();
  drives_.place(pose_.theta_rad);
  return true;
}

Vector3 SimulatedDelta::edge_force() const {
  const Vector3 x = position_m();
  const double r = x.norm();
  if (r <= workspace_m_) return Vector3::Zero();
  const Vector3 outward = x / r;
  const double push = kEdge_n_per_m * (r - workspace_m_) + kEdge_n_s_per_m * outward.dot(v_);
  return -std::max(0.0, push) * outward;
}

void SimulatedDelta::step(double dt_s, const HandModel& hand, const Vector3& hand_m,
                          const Vector3& hand_m_per_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kDeltaStep_s - 1e-9)));
  Hand at{hand, hand_m, hand_m_per_s};
  for (int i = 0; i < steps; ++i) {
    move(dt_s / steps, at);
    at.position_m += dt_s / steps * hand_m_per_s;
  }
}

void SimulatedDelta::move(double dt_s, const Hand& hand) {
  const double half_s = 0.5 * dt_s;
  const Vector3 motor_nm = drives_.run(dt_s);
  const double b = drives_.viscous_nm_s_per_rad(), axis = dynamics_.axis_inertia_kg_m2();
  // Forces that depend only on the position, and the damper of the hand with the target's velocity.
  const auto push = [&](const Vector3& hand_m) -> Vector3 {
    return dynamics_.weight(pose_, gravity_) + edge_force() +
           DeltaDynamics::force(pose_, motor_nm + friction_nm_) +
           hand.model.stiffness_n_per_m * (hand_m - position_m()) +
           hand.model.damping_n_s_per_m * hand.velocity_m_per_s;
  };
  const auto mass = [&]() -> Matrix3 {
    return dynamics_.mass_kg(pose_) + hand.model.mass_kg * Matrix3::Identity();
  };
  const auto damping = [&]() -> Matrix3 {
    return b * pose_.rates.transpose() * pose_.rates + hand.model.damping_n_s_per_m * Matrix3::Identity();
  };
  const auto bias = [&](const Vector3& v) -> Vector3 {
    return axis * DeltaDynamics::force(pose_, dynamics_.rate_bias(pose_, v));
  };
  const Vector3 a = mass().inverse() * (push(hand.position_m) - damping() * v_ - bias(v_));
  const Vector3 v_half = v_ + half_s * a;
  const DeltaPose next = dynamics_.pose(pose_.p_m + dt_s * v_half);
  if (!next.closed) {  // the device cannot reach that pose and stops
    v_.setZero();
    return;
  }
  pose_ = next;
  friction_nm_ = drives_.friction(pose_.theta_rad);
  const Matrix3 M = mass();
  v_ = (M + half_s * damping()).inverse() *
       (M * v_half +
        half_s * (push(hand.position_m + dt_s * hand.velocity_m_per_s) - bias(2.0 * v_half - v_)));
}

double SimulatedDelta::energy_j() const {
  return 0.5 * v_.dot(dynamics_.mass_kg(pose_) * v_) +
         potential_energy(dynamics_.geometry(), dynamics_.masses(), gravity_, pose_.theta_rad, pose_.p_m);
}

}  // namespace longreach
