#pragma once
// The contact law of Hunt and Crossley (1975), with a = λ/k:
//   F(x, v) = k xⁿ (1 + a v)   for a penetration x > 0 and a speed v inwards, at least 0; otherwise 0
// While 1 + a v > 0, the impact of a mass m conserves the quantity
//   H = G(v) + U(x)/m,   G(v) = v/a - ln(1 + a v)/a²,   U(x) = k x^(n+1)/(n+1)
// k is in N/mⁿ. Friction is not modelled.

#include <cmath>

namespace longreach {

struct HuntCrossley {
  double k = 1000.0;  // N/mⁿ, > 0
  double n = 1.0;     // 1 to 3
  double a = 0.1;     // s/m, >= 0

  [[nodiscard]] double force_n(double x, double v) const {
    if (!(x > 0.0)) return 0.0;
    const double force = elastic_n(x) * (1.0 + a * v);
    return force > 0.0 ? force : 0.0;
  }
  [[nodiscard]] double elastic_n(double x) const { return x > 0.0 ? k * std::pow(x, n) : 0.0; }
  /// F/x and dF/dx of the elastic force, N/m; x > 0.
  [[nodiscard]] double secant_n_per_m(double x) const { return k * std::pow(x, n - 1.0); }
  [[nodiscard]] double tangent_n_per_m(double x) const { return n * secant_n_per_m(x); }
  [[nodiscard]] double energy_j(double x) const { return x > 0.0 ? elastic_n(x) * x / (n + 1.0) : 0.0; }

  struct Mean {
    double force_n = 0.0;        // (U(x + dx) - U(x))/dx, without cancellation; increases with dx
    double slope_n_per_m = 0.0;  // derivative of force_n with respect to dx
  };
  /// Mean elastic force over the motion from x to x + dx.
  [[nodiscard]] Mean mean_elastic(double x, double dx) const {
    const double deep = dx > 0.0 ? x + dx : x, way = std::abs(dx);
    if (!(deep > 0.0)) return {};
    const double most = elastic_n(deep), share = way / deep;  // share of the depth
    if (share < 1e-12) return {most, 0.5 * n * most / deep};
    double mean = most / ((n + 1.0) * share), end = dx > 0.0 ? most : 0.0;
    if (share < 1.0) {
      const double spent = std::expm1((n + 1.0) * std::log1p(-share));  // (1 - share)^(n+1) - 1
      mean *= -spent;
      if (dx < 0.0) end = most * (1.0 + spent) / (1.0 - share);
    }
    // Where the quotient would cancel, its limit is used.
    return {mean, share < 1e-4 ? 0.5 * n * mean / deep : (end - mean) / dx};
  }

  /// G(v), m²/s², for 1 + a v > 0.
  [[nodiscard]] double impact_energy(double v) const {
    const double av = a * v;
    if (std::abs(av) > 0.1) return (av - std::log1p(av)) / (a * a);
    double sum = 0.0;  // Σ (-av)^j/(j + 2)
    for (int j = 15; j >= 0; --j) sum = 1.0 / (j + 2) - av * sum;
    return v * v * sum;
  }
};

}  // namespace longreach
