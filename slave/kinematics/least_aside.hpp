#pragma once
// Finds the smallest change of an undetermined angle for which the remaining joints of an arm can reach the
// pose. It needs about 150 evaluations and is used only at singular poses.

#include <cmath>

namespace longreach {

/// Returns the h in [-width, width] nearest to 0 with miss(h) <= 0 or, if there is none, the h with the
/// minimum miss. `miss` must be continuous. Minima narrower than width / 24, the distance between samples,
/// may be missed.
template <typename Miss>
double least_aside(double width, const Miss& miss) {
  constexpr int kSamples = 24, kHalvings = 50;
  constexpr double kShrink = 0.6;
  double best = 0.0, least = miss(0.0);
  const auto try_at = [&](double h) {
    const double m = miss(h);
    if (m < least) least = m, best = h;
  };
  for (int i = 1; i <= kSamples && least > 0.0; ++i) {
    try_at(width * i / kSamples);
    try_at(-width * i / kSamples);
  }
  double step = width / kSamples;
  for (int i = 0; i < kHalvings && least > 0.0; ++i, step *= kShrink) {
    const double middle = best;
    try_at(middle + step);
    try_at(middle - step);
  }
  if (least > 0.0) return best;
  double short_of = 0.0;
  for (int i = 0; i < kHalvings && best != 0.0; ++i) {
    const double middle = 0.5 * (short_of + best);
    (miss(middle) <= 0.0 ? best : short_of) = middle;
  }
  return best;
}

}  // namespace longreach
