#pragma once
// Roots of a trigonometric polynomial of degree 4, F(φ) = Σ (a_k cos kφ + b_k sin kφ), k <= 4, from its
// values at kSamples equally spaced angles. The polynomial is written in t = tan(χ/2), where χ is counted
// from the angle opposite the largest sample. The leading coefficient of the octic in t is then the largest
// value of F, so that the companion matrix is well scaled and no root is lost at infinity. This is the only
// file that uses a general eigenvalue solver.

#include <array>

namespace longreach {

struct OcticRoots {
  static constexpr int kSamples = 16;

  enum class Outcome { kFound, kVanishes, kNotConverged };
  Outcome outcome = Outcome::kNotConverged;  // kVanishes: F is zero everywhere, within rounding error
  int count = 0;                    // number of roots whose distance from the real axis is at most `kBeside`
  std::array<double, 8> phi_rad{};  // approximate roots, to be polished
};

/// Maximum distance from the real axis, rad, at which a root is listed. It is not zero, because rounding
/// splits a double root by the square root of the rounding error.
constexpr double kBeside = 0.02;

/// Returns the real roots of the polynomial with the values `F`. `scale` is the magnitude of the terms of F,
/// with which F is compared to decide whether it vanishes.
OcticRoots octic_roots(const std::array<double, OcticRoots::kSamples>& F, double scale);

}  // namespace longreach
