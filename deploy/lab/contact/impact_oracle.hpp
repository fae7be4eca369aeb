#pragma once
// Reference solution of a free impact on a Hunt-Crossley contact, computed from integrals in long double,
// without time steps.
//   G(v) = v - ln(1 + v) in units of 1/a;  G(-e vi) = G(vi);  U(x_max) = m G(vi)
//   duration: ∫dx/v from the surface to v = vi/2, ∫dv/v̇ from there to v = -e vi/2, ∫dx/v back to the surface

#include <cmath>

namespace longreach::test {

struct ImpactOracle {
  long double m, k, n, a, vi;

  static long double log_part(long double u) {  // u - ln(1 + u)
    if (std::abs(u) > 0.05L) return u - std::log1p(u);
    long double sum = 0.0L;
    for (int j = 30; j >= 0; --j) sum = 1.0L / (j + 2) - u * sum;
    return u * u * sum;
  }
  [[nodiscard]] long double G(long double v) const {
    return a == 0.0L ? 0.5L * v * v : log_part(a * v) / (a * a);
  }
  /// Solves G = value, for v > 0 (sign 1) or v < 0 (sign -1).
  [[nodiscard]] long double speed_of(long double value, long double sign) const {
    long double low = 0.0L, high = sign < 0.0L && a > 0.0L ? std::min(vi, (1.0L - 1e-18L) / a) : vi;
    for (int i = 0; i < 120; ++i) {
      const long double middle = 0.5L * (low + high);
      (G(sign * middle) < value ? low : high) = middle;
    }
    return 0.5L * (low + high);
  }
  [[nodiscard]] long double depth_at(long double v) const {
    return std::pow((n + 1.0L) * m / k * (G(vi) - G(v)), 1.0L / (n + 1.0L));
  }
  [[nodiscard]] long double restitution() const { return speed_of(G(vi), -1.0L) / vi; }
  [[nodiscard]] long double penetration_max() const { return depth_at(0.0L); }
  [[nodiscard]] long double duration() const {
    const long double out = speed_of(G(vi), -1.0L);
    // Time between the surface and the depth at which the speed is `to`.
    const auto through = [&](long double to, long double sign) {
      return simpson(0.0L, depth_at(to), [&](long double x) {
        return 1.0L / speed_of(G(vi) - k / m * std::pow(x, n + 1.0L) / (n + 1.0L), sign);
      });
    };
    const long double turning = simpson(-0.5L * out, 0.5L * vi, [&](long double v) {
      return 1.0L / ((1.0L + a * v) * k / m * std::pow(depth_at(v), n));
    });
    return through(0.5L * vi, 1.0L) + turning + through(-0.5L * out, -1.0L);
  }

 private:
  template <class F>
  static long double simpson(long double from, long double to, F f) {
    constexpr int kHalves = 40;
    const long double h = (to - from) / (2 * kHalves);
    long double sum = f(from) + f(to);
    for (int i = 1; i < 2 * kHalves; ++i) sum += (i % 2 == 1 ? 4.0L : 2.0L) * f(from + i * h);
    return sum * h / 3.0L;
  }
};

}  // namespace longreach::test
