#pragma once
// The way of one trial: the straight lines and quarter turns of the scene's path, put together in a random
// order, so that nobody learns it by heart. Each turn leads from one axis of the scene to the next (x, y, z,
// x), as in the scene: the way never comes back to itself.

#include <vector>

#include "common/core/random.hpp"
#include "slave/config/scene_config.hpp"

namespace longreach {

/// What the operator goes for next. Distances from where the tool started, in W.
struct PathAim {
  Vector3 at_m = Vector3::Zero();
  bool target = false;  // end of a line or turn
};

struct PathCourse {
  PathConfig path{};          // from where the tool starts
  std::vector<PathAim> aims;  // ends of lines and turns, and between them stretches of at most 30 mm or 30°
  std::vector<Vector3> drawn_m;  // close enough to be joined by lines in a picture
  double length_m = 0.0;
};

/// Of the lines and turns of `scene`, which turns by right angles only.
PathCourse shuffled_course(const PathConfig& scene, Random random);

}  // namespace longreach
