#pragma once
// Extracts the moment of a rotational contact from the measured moment. A force F that acts at r causes the
// moment r x F about the tool, which is perpendicular to F and at most |r| |F|. That part of the measured
// moment is attributed to the force and its lever:
//   τ_free = τ - min(1, L |F|/|τ_across|) τ_across,  τ_across = τ - (τ·F) F/|F|²
// L is the longest lever of a tool. No moment is attributed to a force within the noise. If a force and a
// rotational stop about a perpendicular axis act at the same time, the stop is detected only if its moment
// exceeds L |F|.

#include "common/spatial/spatial.hpp"

namespace longreach {

constexpr double kToolLever_m = 0.3;
/// A smaller force is treated as noise.
constexpr double kForceSeen_n = 0.2;

/// Returns the moment that a rotational contact exerts on the tool at E, in W, N m.
inline Vector3 free_moment_nm(const Wrench& F_E_W) {
  const double force_n = F_E_W.force.norm();
  if (!(force_n > kForceSeen_n)) return F_E_W.moment;
  const Vector3 along = F_E_W.force / force_n;
  const Vector3 across_nm = F_E_W.moment - along.dot(F_E_W.moment) * along;
  const double size_nm = across_nm.norm(), lever_nm = kToolLever_m * force_n;
  return F_E_W.moment - (size_nm > lever_nm ? lever_nm / size_nm : 1.0) * across_nm;
}

}  // namespace longreach
