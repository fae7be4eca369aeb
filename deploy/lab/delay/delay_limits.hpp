#pragma once
// The maximum stiffness of the comparison laws with a delay: measured on the bench, and by theory.

#include "deploy/lab/delay/bilateral_bench.hpp"

namespace longreach {

/// Device and hand as one linear mass, damper and spring, at home along the vertical.
struct HeldHandle {
  double mass_kg = 0.0;
  double n_s_per_m = 0.0;
  double n_per_m = 0.0;
};
HeldHandle held_handle(const DeviceConfig& device, Grip grip);

/// A device with a handle of `mass_kg` and this damping, at home along the vertical; otherwise ideal. The
/// mass must be above that of the arms.
DeviceConfig ideal_handle(const DeviceConfig& device, double mass_kg, double n_s_per_m);

/// Delay margin of direct force reflection: the minimum K at which  m s² + b s + k + K exp(-s τ)
/// has a root jω,
///   K = |k - m ω² + j b ω|  over the ω with  ω τ + arg(k - m ω² + j b ω) = π, 3π, 5π ...
/// τ is the total delay of the loop, including half a sample for the held force.
double direct_limit_n_per_m(const HeldHandle& handle, double loop_delay_s);

/// Stiffness of a wave line, 2 b/RTT: a line shut at its far end is b coth(s RTT/2), near zero b/(s RTT/2).
inline double wave_line_n_per_m(double impedance, double rtt_s) { return 2.0 * impedance / rtt_s; }

/// Maximum coupling of position-position permitted by 4 Bm Bs > (T1² + T2²) Kc², each direction half of the
/// RTT.
double position_position_limit_n_per_m(double master_n_s_per_m, double slave_n_s_per_m, double rtt_s);

/// Stiffness of two springs in series.
inline double in_series(double a, double b) { return a * b / (a + b); }

/// Maximum wall stiffness at which direct force reflection is stable: a small disturbance of a handle at rest
/// in the wall decays; by bisection to `tolerance`, up to `most_n_per_m`. The wall of the case is ignored.
double measured_direct_limit_n_per_m(const BilateralCase& c, double most_n_per_m, double tolerance);

}  // namespace longreach
