#pragma once
// The last stage before the motors, for one port: the translational or the rotational hand. Watches the
// energy that goes through it and keeps it passive, limits the force and its rise, and ramps it away.
//
// Port energy is summed exactly as the motors deliver it, with the force held over a sample:
//   E_port += -f[k-1] . (x[k] - x[k-1])      (positive: from the hand into the device)
// A spring held for a sample acts like negative damping K T/2; where E_port - E_stored falls for that reason
// and the tank cannot pay, the deficit is paid back by injected damping, at most 0.4 m/T with m the handle
// alone (Hannaford and Ryu 2002, bounded), and within the limits of force and rise as all else is. Damping on
// the velocity of one encoder count in a sample would feed the handle instead: the velocity is that of
// quantized_motion_filter.hpp. Force in N and motion in m, or N m and rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct PortGuardConfig {
  double handle_mass = 0.2;  // kg, or kg m²
  double force_max = 15.0;
  double slew_per_s = 5000.0;  // largest rise of the force, N/s
  double ramp_s = 0.05;
  double freed_damping =
      0.0;  // of a hand whose contact has just ended by a stop, a change of mode or the clutch, N s/m
};

/// What the hand shall feel in this tick.
struct PortForce {
  Vector3 rendered = Vector3::Zero();  // ramps to zero when nothing is engaged
  Vector3 always = Vector3::Zero();    // does not
  Vector3 rate = Vector3::Zero();      // of the handle, as far as it is certain
  bool live = false;
};

class PortGuard {
 public:
  explicit PortGuard(const PortGuardConfig& config) : config_(config) {}
  void configure(const PortGuardConfig& config) { config_ = config; }
  /// No energy has come in and none is owed. The next force rises from the one that the hand has.
  void reset();
  void open() { gain_ = 1.0; }  // after reset, when every spring is at rest

  /// Energy that entered the port since the last tick, J, by the motion `moved`. Call once a tick, before the
  /// new force.
  double observe(const Vector3& moved);

  /// The contact force ends though the hand may still press: it is let down by damping.
  void free_hand() { freed_s_ = kFreed_s; }

  /// Pays the deficit from `energy_j` >= 0 that was dissipated; returns what is left.
  double repay(double energy_j);
  /// Books `energy_j` >= 0 that leaked and that no tank could pay.
  void owe(double energy_j) {
    deficit_j_ += energy_j;
    deficit_max_j_ = std::max(deficit_max_j_, deficit_j_);
  }

  /// Force on the hand: with injected damping, ramp and limits. Never non-finite.
  Vector3 apply(const PortForce& force, double dt_s);

  /// Share of `rendered` that the hand was given in the last tick.
  [[nodiscard]] double gain() const { return gain_; }
  [[nodiscard]] double port_energy_j() const { return port_energy_j_; }
  [[nodiscard]] double deficit_max_j() const { return deficit_max_j_; }  // largest fall of E_port - E_stored
  [[nodiscard]] bool injecting() const { return injecting_; }
  [[nodiscard]] bool clamped() const { return clamped_; }

 private:
  static constexpr double kFreed_s = 0.6;

  PortGuardConfig config_;
  Vector3 f_last_ = Vector3::Zero();   // whose work is booked
  Vector3 f_given_ = Vector3::Zero();  // that the hand has
  double port_energy_j_ = 0.0;
  double deficit_j_ = 0.0;
  double deficit_max_j_ = 0.0;
  double gain_ = 0.0;
  double freed_s_ = 0.0;  // for so long the hand is let down
  bool injecting_ = false;
  bool clamped_ = false;
};

}  // namespace longreach
