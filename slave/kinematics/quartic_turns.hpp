#pragma once
// Zeros of a trigonometric polynomial of second degree on the circle,
//   F(φ) = A + B cos φ + C sin φ + D cos 2φ + E sin 2φ,
// at most four. In t = tan(χ/2), χ counted from opposite the largest of eight samples, F is a quartic whose
// leading coefficient is that sample, so all zeros are moderate. Its real zeros are bracketed by those of its
// derivatives, so none is missed, and each is found by Newton steps within the bracket. A point where F
// nearly touches zero (below kTouch of `size`) is also listed, with a neighbour on either side: rounding
// decides whether there are two zeros, one or none.

#include <array>

namespace longreach {

/// k + c cos φ + s sin φ
struct Trig {
  double k = 0.0, c = 0.0, s = 0.0;
};

/// A rotation in the plane; c² + s² = 1.
struct Turn {
  double c = 1.0, s = 0.0;
};

struct Trig2 {
  double A = 0.0, B = 0.0, C = 0.0, D = 0.0, E = 0.0;
};

/// weight f(φ)²
Trig2 squared(const Trig& f, double weight);

constexpr double kTouch = 1e-11;

struct QuarticTurns {
  static constexpr int kMax = 13;  // four zeros, and three touching points with a neighbour on either side
  int count = 0;
  std::array<Turn, kMax> turn{};
};

/// `size`: magnitude of the terms of F.
QuarticTurns zeros(const Trig2& F, double size);

}  // namespace longreach
