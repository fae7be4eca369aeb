#pragma once
// Steps in which keys and buttons change the gains of the mapping: k_scale by 0.05, to multiples of 0.05; kv by a factor of
// 1.25. The ranges are those of the schema. kv of translation and rotation change by the same factor, so that their ratio
// stays, unless one of them reaches the end of its range.

#include <algorithm>
#include <cmath>

namespace longreach {

constexpr double kScaleStep = 0.05, kScaleMost = 1.0;
constexpr double kKvStep = 1.25, kKvMin_per_s = 0.001, kKvMax_per_s = 1000.0;

inline bool is_scale(double scale) { return scale >= kScaleStep - 1e-12 && scale <= kScaleMost; }
inline bool is_kv(double kv_per_s) { return kv_per_s >= kKvMin_per_s && kv_per_s <= kKvMax_per_s; }

/// Returns `scale` after a number of steps, within its range.
inline double stepped_scale(double scale, int steps) {
  if (steps != 0) scale = std::round(scale / kScaleStep + steps) * kScaleStep;
  return std::clamp(scale, kScaleStep, kScaleMost);
}

/// Returns kv after a number of steps, within its range.
inline double stepped_kv(double kv_per_s, int steps) {
  constexpr int kMost = 100;  // more than the whole range
  return std::clamp(kv_per_s * std::pow(kKvStep, std::clamp(steps, -kMost, kMost)), kKvMin_per_s,
                    kKvMax_per_s);
}

}  // namespace longreach
