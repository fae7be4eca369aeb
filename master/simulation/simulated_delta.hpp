#pragma once
// Simulation of a DELTA device: mechanism, drives, the mechanical limit of its workspace, and the hand on the
// handle.
//
//   (M + m_hand) a = F_hand + F_weight + F_edge + Wᵀ (τ_motor + τ_friction - b W v - I β)
//
// The equation is integrated by velocity Verlet with implicit damping in the second half-step: second order,
// without energy drift in the absence of friction. The steps are at most 1 ms; motor torques are held between
// commands.

#include "master/devices/delta/delta_dynamics.hpp"
#include "master/devices/drive/drives.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {

class SimulatedDelta {
 public:
  /// Throws GeometryError for an impossible device, or if the workspace is not completely reachable.
  explicit SimulatedDelta(const DeviceConfig& config);

  /// Places the handle at `x_m` from home, at rest. Returns false and changes nothing if the position is not
  /// reachable.
  bool place(const Vector3& x_m);

  /// Advances by `dt_s` > 0. `hand_m` (from home) and `hand_m_per_s` are the position and velocity of the
  /// hand's target at the beginning of the step.
  void step(double dt_s, const HandModel& hand, const Vector3& hand_m, const Vector3& hand_m_per_s);

  /// Sets the commanded motor torques.
  void command(const Vector3& tau_nm) { drives_.command(tau_nm); }
  [[nodiscard]] Vector3 encoder_rad() const { return drives_.encoder(pose_.theta_rad); }

  [[nodiscard]] const DeltaDynamics& dynamics() const { return dynamics_; }
  /// True position relative to home.
  [[nodiscard]] Vector3 position_m() const { return pose_.p_m - dynamics_.home_m(); }
  [[nodiscard]] const Vector3& velocity_m_per_s() const { return v_; }
  [[nodiscard]] double energy_j() const;  // kinetic and potential energy, without the hand

 private:
  struct Hand {
    HandModel model;
    Vector3 position_m, velocity_m_per_s;
  };
  void move(double dt_s, const Hand& hand);
  [[nodiscard]] Vector3 edge_force() const;
  void require_workspace() const;

  DeltaDynamics dynamics_;
  Drives drives_;
  Vector3 gravity_;
  double workspace_m_;
  DeltaPose pose_{};
  Vector3 v_ = Vector3::Zero();
  Vector3 friction_nm_ = Vector3::Zero();
};

}  // namespace longreach
