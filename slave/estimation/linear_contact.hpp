#pragma once
// Common part of the two-parameter contact laws: a least squares fit of F = c0 φ0 + c1 φ1, which yields f =
// c0 and a = c1/c0.

#include "slave/estimation/contact_fit.hpp"
#include "slave/estimation/normal_equations.hpp"

namespace longreach {

struct LinearContact {
  double reference_m = 0.0;  // 0: no sample yet
  NormalEquations<2> equations;
  ContactFit fit{};

  /// Processes a sample with the regressors `phi`. Returns the force minus the predicted force, N; NaN while
  /// there is no fit.
  double step(const Eigen::Vector2d& phi, const PenetrationSample& sample, double forgetting,
              double variance_n2, double n) {
    const double innovation =
        fit.valid ? sample.force_n - fit.force_n * (phi[0] + fit.a_s_per_m * phi[1]) : std::nan("");
    equations.add(phi, sample.force_n, forgetting);
    const Eigen::Matrix2d inverse = equations.inverse();
    const Eigen::Vector2d c = inverse * equations.b();
    const double a = c[1] / c[0];
    fit.reference_m = reference_m;
    fit.n = n;
    fit.force_n = c[0];
    fit.a_s_per_m = a;
    Eigen::Matrix<double, 3, 2> J;  // derivative of (ln f, n, a) with respect to c
    J << 1.0 / c[0], 0.0, 0.0, 0.0, -a / c[0], 1.0 / c[0];
    fit.covariance.topLeftCorner<3, 3>() = variance_n2 * J * inverse * J.transpose();
    fit.valid = c[0] > 0.0 && fit.covariance.allFinite();
    return innovation;
  }
};

}  // namespace longreach
