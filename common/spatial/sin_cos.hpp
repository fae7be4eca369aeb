#pragma once
// Fast sine and cosine of the same angle, with a third of the instructions of the C library (which also saves
// the rounding mode), for code that computes many of them per step. It uses the reduction to [-π/4, π/4] with
// π/2 in two parts (33 + 53 bits) and the polynomials of fdlibm's __kernel_sin and __kernel_cos (Sun
// Microsystems 1993). The error is at most one unit in the last place of 1. The C library is used for
// arguments that are not finite or exceed kReducible radians.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace longreach {

struct SinCos {
  double s = 0.0;
  double c = 1.0;
};

/// Intermediate result: sine and cosine of x minus the nearest multiple of π/2, for |x| < kReducible.
/// in_quadrant() swaps and negates them according to the last bits of `quadrant`.
struct ReducedSinCos {
  static constexpr double kReducible = 1e5;
  double s, c, quadrant;
};

inline ReducedSinCos reduced_sin_cos(double x) {
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kHalfPiHigh = 1.57079632673412561417e+00, kHalfPiLow = 6.07710050650619224932e-11;
  constexpr double kRound = 0x1.8p52;  // adding it rounds to an integer, which is in the last bits of the sum
  const double shifted = x * kTwoOverPi + kRound;
  const double turns = shifted - kRound;
  const double y = (x - turns * kHalfPiHigh) - turns * kHalfPiLow;
  const double z = y * y;
  const double s =
      y + y * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 +
                              z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const double tail = z * z *
                      (4.16666666666666019037e-02 +
                       z * (-1.38888888888741095749e-03 +
                            z * (2.48015872894767294178e-05 +
                                 z * (-2.75573143513906633035e-07 +
                                      z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const double half = 0.5 * z, head = 1.0 - half;
  return {s, head + (((1.0 - head) - half) + tail), shifted};
}

inline SinCos in_quadrant(const ReducedSinCos& r) {
  // Selects with bit operations instead of branches, because the quadrant is unpredictable.
  const auto quadrant = std::bit_cast<std::uint64_t>(r.quadrant);
  const auto s = std::bit_cast<std::uint64_t>(r.s), c = std::bit_cast<std::uint64_t>(r.c);
  const std::uint64_t swapped = (s ^ c) & (0 - (quadrant & 1));
  return {std::bit_cast<double>(s ^ swapped ^ ((quadrant & 2) << 62)),
          std::bit_cast<double>(c ^ swapped ^ (((quadrant + 1) & 2) << 62))};
}

inline SinCos sin_cos(double x) {
  if (!(std::abs(x) < ReducedSinCos::kReducible)) return {std::sin(x), std::cos(x)};
  return in_quadrant(reduced_sin_cos(x));
}

/// Computes sine and cosine of several angles at once: two angles take as long as one.
template <std::size_t n>
inline std::array<SinCos, n> sin_cos(const std::array<double, n>& x) {
  double s[n], c[n];
  bool reducible = true;
  for (std::size_t i = 0; i < n; ++i) {
    const SinCos t = in_quadrant(reduced_sin_cos(x[i]));
    s[i] = t.s, c[i] = t.c;
  }
  std::array<SinCos, n> result;
  for (std::size_t i = 0; i < n; ++i) {
    reducible = reducible && std::abs(x[i]) < ReducedSinCos::kReducible;
    result[i] = {s[i], c[i]};
  }
  if (reducible) return result;
  for (std::size_t i = 0; i < n; ++i) result[i] = sin_cos(x[i]);
  return result;
}

}  // namespace longreach
