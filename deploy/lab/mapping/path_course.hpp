#pragma once
// The path of one trial: the straight lines and quarter turns of the scene's path, in a random order, so that
// it cannot be memorised. Each turn leads from one axis of the scene to the next (x, y, z, x), as in the
// scene: the path never returns to itself.

#include <vector>

#include "common/core/random.hpp"
#include "slave/config/scene_config.hpp"

namespace longreach {

/// Next aim of the operator. Distances from the start of the tool, in W.
struct PathAim {
  Vector3 at_m = Vector3::Zero();
  bool target = false;  // end of a line or turn
};

struct PathCourse {
  PathConfig path{};             // from the start of the tool
  std::vector<PathAim> aims;     // ends of lines and turns, and between them steps of at most 30 mm or 30°
  std::vector<Vector3> drawn_m;  // points for drawing the path with straight lines
  double length_m = 0.0;
};

/// From the lines and turns of `scene`, which must have right angles only.
PathCourse shuffled_course(const PathConfig& scene, Random random);

}  // namespace longreach
