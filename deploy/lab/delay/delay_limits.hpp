#pragma once
// The maximum stiffness of the comparison laws under delay, as measured on the bench and as predicted by
// theory.

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

/// Device and hand as one linear mass-spring-damper at home, for vertical motion.
struct HeldHandle {
  double mass_kg = 0.0;
  double n_s_per_m = 0.0;
  double n_per_m = 0.0;
};
HeldHandle held_handle(const DeviceConfig& device, Grip grip);

/// Returns an ideal device that has this mass and damping for vertical motion at home. The mass must exceed
/// that of the arms.
DeviceConfig ideal_handle(const DeviceConfig& device, double mass_kg, double n_s_per_m);

/// Stability limit of direct force reflection: the minimum K at which  m s² + b s + k + K exp(-s τ) has a
/// root jω,
///   K = |k - m ω² + j b ω|  over the ω with  ω τ + arg(k - m ω² + j b ω) = π, 3π, 5π ...
/// τ is the total delay of the loop, including half a sample for the zero-order hold of the force.
double direct_limit_n_per_m(const HeldHandle& handle, double loop_delay_s);

/// Stiffness of a wave line, 2 b/RTT: the impedance of a line with a fixed far end is b coth(s RTT/2), which
/// approaches b/(s RTT/2) near s = 0.
inline double wave_line_n_per_m(double impedance, double rtt_s) { return 2.0 * impedance / rtt_s; }

/// Maximum coupling stiffness Kc of the position-position law according to 4 Bm Bs > (T1² + T2²) Kc², where
/// each of the delays T1 and T2 is half of the RTT.
double position_position_limit_n_per_m(double master_n_s_per_m, double slave_n_s_per_m, double rtt_s);

/// Stiffness of two springs in series.
inline double in_series(double a, double b) { return a * b / (a + b); }

/// Maximum wall stiffness at which direct force reflection is stable, i.e. a small disturbance of a handle at
/// rest in the wall decays. Found by bisection to `tolerance`, up to `most_n_per_m`. The wall stiffness of
/// the case is ignored.
double measured_direct_limit_n_per_m(const BilateralCase& c, double most_n_per_m, double tolerance);

}  // namespace longreach
