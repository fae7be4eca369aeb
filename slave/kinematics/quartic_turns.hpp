#pragma once
// Finds the zeros, at most four, of a trigonometric polynomial of second degree on the circle,
//   F(φ) = A + B cos φ + C sin φ + D cos 2φ + E sin 2φ
// In t = tan(χ/2), with χ measured from the point opposite the largest of eight samples, F is a quartic whose
// leading coefficient is that sample, so all zeros are of moderate size. The zeros of its derivatives bracket
// its real zeros, so none is missed, and Newton steps find each zero within its bracket. A point where F
// nearly touches zero (below kTouch times `size`) is also listed, with a neighbour on either side, because
// rounding decides whether there are two zeros, one or none.

#include <array>

namespace longreach {

/// The function k + c cos φ + s sin φ.
struct Trig {
  double k = 0.0, c = 0.0, s = 0.0;
};

/// Cosine and sine of a rotation in the plane; c² + s² = 1.
struct Turn {
  double c = 1.0, s = 0.0;
};

struct Trig2 {
  double A = 0.0, B = 0.0, C = 0.0, D = 0.0, E = 0.0;
};

/// Returns weight f(φ)².
Trig2 squared(const Trig& f, double weight);

constexpr double kTouch = 1e-11;

struct QuarticTurns {
  static constexpr int kMax = 13;  // four zeros, plus three touching points with a neighbour on either side
  int count = 0;
  std::array<Turn, kMax> turn{};
};

/// Returns the zeros of F; `size`: magnitude of the terms of F.
QuarticTurns zeros(const Trig2& F, double size);

}  // namespace longreach
