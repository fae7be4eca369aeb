#pragma once
// Input and output of the estimators in slave/estimation.
//   F = f (ξⁿ + a v ξᵐ),  ξ = (x - x0)/x_ref;  m = n: Hunt-Crossley, k = f/x_refⁿ, λ = a k;
//                                              m = 0: Kelvin-Voigt, of external estimators only
// The parameters refer to a depth x_ref that the tool reached, so none of them depends on the unit of length.
// k in N/mⁿ, by contrast, extrapolates to a depth of one metre.

#include <Eigen/Core>
#include <cmath>

namespace longreach {

struct PenetrationSample {
  /// Position along the inward normal, relative to the surface if its position is known.
  double x_m = 0.0;
  double v_m_per_s = 0.0;  // derivative of x_m
  double force_n = 0.0;    // measured force along the outward normal
};

struct ContactFit {
  bool valid = false;
  double reference_m = 1.0;  // x_ref
  double surface_m = 0.0;    // x0; 0 if the surface is known or at the origin
  double force_n = 0.0;      // f, elastic force at the depth x_ref
  double n = 1.0;
  double a_s_per_m = 0.0;
  bool kelvin_voigt = false;                             // m = 0
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  // covariance of (ln f, n, a, x0)

  /// Predicted force, N; 0 in front of the surface.
  [[nodiscard]] double force_at(const PenetrationSample& sample) const {
    const double xi = (sample.x_m - surface_m) / reference_m;
    if (!(xi > 0.0)) return 0.0;
    const double elastic = n == 1.0 ? xi : std::pow(xi, n);
    return force_n * (elastic + a_s_per_m * sample.v_m_per_s * (kelvin_voigt ? 1.0 : elastic));
  }
};

}  // namespace longreach
