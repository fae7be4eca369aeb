#pragma once
// The last stage before the motors, for one port: the translational or the rotational handle. It monitors the
// energy at the port and keeps the port passive, limits the force and its rate, and ramps the force to zero.
//
// The port energy is summed exactly as the motors deliver it, with the force held over a sample:
//   E_port += -f[k-1] . (x[k] - x[k-1])      (positive: from the hand into the device)
// A spring whose force is held for a sample acts like negative damping K T/2. If E_port - E_stored decreases
// for this reason and the tank is empty, the deficit is repaid by injected damping of at most 0.4 m/T, within
// the limits of force and rate; m is the mass of the handle alone (bounded as in Hannaford and Ryu 2002).
// Damping computed from single encoder counts would supply energy to the handle, so the velocity from
// quantized_motion_filter.hpp is used. Forces are in N and motions in m, or N m and rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct PortGuardConfig {
  double handle_mass = 0.2;  // kg, or kg m²
  double force_max = 15.0;
  double slew_per_s = 5000.0;  // maximum rate of the force, N/s
  double ramp_s = 0.05;
  /// Damping, N s/m, that slows the hand down after a stop, a mode change or the clutch ended a contact.
  double freed_damping = 0.0;
};

/// Commanded force in this tick.
struct PortForce {
  Vector3 rendered = Vector3::Zero();  // force that ramps to zero when disengaged
  Vector3 always = Vector3::Zero();    // force that is independent of the engagement
  Vector3 rate = Vector3::Zero();      // certain velocity (quantized_motion_filter.hpp)
  bool live = false;
};

class PortGuard {
 public:
  explicit PortGuard(const PortGuardConfig& config) : config_(config) {}
  void configure(const PortGuardConfig& config) { config_ = config; }
  /// Starts an engagement at full force and without a deficit. The rate limit continues from the current force, and the
  /// damping of a freed hand fades.
  void open() {
    gain_ = 1.0;
    deficit_j_ = freed_s_ = 0.0;
  }

  /// Returns the energy that entered the port by the motion `moved` since the last tick, J. Call this once
  /// per tick, before apply().
  double observe(const Vector3& moved);

  /// Starts damping for kFreed_s, which begins and ends by a ramp. Call this when the contact force ends although the hand
  /// may still be pushing the handle.
  void free_hand() { freed_s_ = kFreed_s; }

  /// Reduces the deficit by the dissipated energy `energy_j` >= 0. Returns the part that exceeds the deficit,
  /// J.
  double repay(double energy_j);
  /// Adds `energy_j` >= 0, which leaked and could not be taken from a tank, to the deficit.
  void owe(double energy_j) {
    deficit_j_ += energy_j;
    deficit_max_j_ = std::max(deficit_max_j_, deficit_j_);
  }

  /// Applies ramp, injected damping and limits. Returns the force on the hand, which is always finite.
  Vector3 apply(const PortForce& force, double dt_s);

  /// Fraction of `rendered` that was applied in the last tick.
  [[nodiscard]] double gain() const { return gain_; }
  /// Net energy from the hand into the device.
  [[nodiscard]] double port_energy_j() const { return port_energy_j_; }
  /// Maximum decrease of E_port - E_stored, J.
  [[nodiscard]] double deficit_max_j() const { return deficit_max_j_; }
  /// Damping was injected in the last tick.
  [[nodiscard]] bool injecting() const { return injecting_; }
  /// The force or its rate was limited in the last tick.
  [[nodiscard]] bool clamped() const { return clamped_; }

 private:
  /// Returns the damping of a freed hand, N s/m.
  double freed_damping(double dt_s);

  static constexpr double kFreed_s = 0.4;

  PortGuardConfig config_;
  Vector3 f_last_ = Vector3::Zero();   // force from which observe() computes the port energy
  Vector3 f_given_ = Vector3::Zero();  // current force on the hand
  double port_energy_j_ = 0.0;
  double deficit_j_ = 0.0;
  double deficit_max_j_ = 0.0;
  double gain_ = 0.0;
  double freed_s_ = 0.0;      // remaining duration of the damping after a contact ended
  double freed_share_ = 0.0;  // of this damping, in effect
  bool injecting_ = false;
  bool clamped_ = false;
};

}  // namespace longreach
