#pragma once
// Simulates the drives of a device: its three motors, their friction and their encoders.
//
//   motor     τ' = (τ_c - τ)/t_m,  t_m = 1/(2π bandwidth);  |τ_c| <= torque_max;
//             commands may be delayed by some samples
//   friction  Coulomb friction as an elastic element that slips (Prandtl): τ_f = -σ z;
//             z follows the axis within ± τ_C/σ. It holds without creep, dissipates
//             exactly, and stores at most τ_C²/(2σ).
//   encoder   rounds to the resolution
//
// Viscous friction is part of the mechanism, which integrates it implicitly.

#include <array>
#include <cstdint>

#include "common/spatial/spatial.hpp"
#include "schema/config_master.hpp"

namespace longreach {

class Drives {
 public:
  static constexpr std::uint32_t kMostDelay = 4;  // maximum delay, samples
  static constexpr int kElements = 6;

  Drives(const DriveConfig& config, std::uint32_t delay_samples);

  /// Sets the torques commanded by the controller, N m. Call this once per sample. A non-finite value counts
  /// as zero.
  void command(const Vector3& tau_nm);

  /// Advances the motors by `dt_s`. Returns their mean torque over that time, N m.
  Vector3 run(double dt_s);

  /// Places the axes at these angles, without friction torque.
  void place(const Vector3& theta_rad);

  /// Moves the axes to these angles. Returns the friction torque at these angles, N m.
  Vector3 friction(const Vector3& theta_rad);

  /// Returns the encoder reading, rad, at these axis angles.
  [[nodiscard]] Vector3 encoder(const Vector3& theta_rad) const;
  [[nodiscard]] double viscous_nm_s_per_rad() const { return config_.viscous_nm_s_per_rad; }

 private:
  DriveConfig config_;
  std::uint32_t delay_samples_;
  double lag_s_;
  std::array<Vector3, kMostDelay + 1> waiting_{};  // delayed commands, newest first
  Vector3 tau_ = Vector3::Zero();
  Vector3 theta_ = Vector3::Zero();
  double presliding_rad_;
  std::array<Vector3, kElements> stretch_{};  // z_i
};

}  // namespace longreach
