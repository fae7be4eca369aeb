#pragma once
// The theoretical maximum stiffness of a virtual wall rendered by a sampled device:
//
//   m x'' + b x' + k x = u,  u held for a sample,  u[j] = -K x[j-d] - B (x[j-d] - x[j-d-1])/T
//
// m, b and k are the mass, damping and stiffness of device and hand together. exact_limit_n_per_m returns the
// K at which the spectral radius of the discrete model is 1. The other two functions return textbook limits.

namespace longreach {

struct SampledWall {
  double mass_kg = 0.0;
  double device_n_s_per_m = 0.0;  // physical damping of the device
  double hand_n_s_per_m = 0.0;
  double hand_n_per_m = 0.0;
  double wall_n_s_per_m = 0.0;  // B
  double period_s = 0.001;
  int delay_samples = 0;  // d
};

/// Spectral radius of the discrete model with this wall stiffness.
double spectral_radius(const SampledWall& wall, double stiffness_n_per_m);

/// Maximum K with a spectral radius of at most 1, N/m; 0 if even a small K is unstable.
double exact_limit_n_per_m(const SampledWall& wall);

/// Limit according to K (T/2 + t_d) = b + B, which holds for small delays and neglects the stiffness of the
/// hand.
double formula_limit_n_per_m(const SampledWall& wall);

/// Limit according to b_device = K T/2 + |B| (Colgate and Schenkel 1997), up to which the wall is passive
/// with any hand. Delays are neglected.
double passive_limit_n_per_m(const SampledWall& wall);

}  // namespace longreach
