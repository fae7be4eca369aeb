#pragma once
// Roots of a trigonometric polynomial of degree 4, F(φ) = Σ (a_k cos kφ + b_k sin kφ), k <= 4, from its
// values at kSamples equally spaced angles. Written in t = tan(χ/2), χ counted from opposite the largest
// sample, so that the leading coefficient of the octic in t is the largest value of F: its companion matrix
// is tame and no root is lost at infinity. The only file that uses a general eigenvalue solver.

#include <array>

namespace longreach {

struct OcticRoots {
  static constexpr int kSamples = 16;

  enum class Outcome { kFound, kVanishes, kNotConverged };
  Outcome outcome = Outcome::kNotConverged;  // kVanishes: F is zero everywhere, to rounding
  int count = 0;                             // real roots and pairs that are within `kBeside` of being real
  std::array<double, 8> phi_rad{};           // first approximations
};

/// Maximum distance from the real axis, rad, at which a root is listed: a double root splits by the root of
/// the rounding error.
constexpr double kBeside = 0.02;

/// `scale`: size of the terms of F, relative to which F vanishes.
OcticRoots octic_roots(const std::array<double, OcticRoots::kSamples>& F, double scale);

}  // namespace longreach
