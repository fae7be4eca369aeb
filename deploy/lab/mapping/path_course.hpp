#pragma once
// The path of one trial: the straight lines and quarter turns of the path in the scene, in random order, so
// that the path cannot be memorised. As in the scene, each turn leads from one axis to the next (x, y, z, x),
// so that the path never crosses itself.

#include <vector>

#include "common/core/random.hpp"
#include "schema/config_scene.hpp"

namespace longreach {

/// A point at which the operator aims.
struct PathAim {
  Vector3 at_m = Vector3::Zero();
  bool target = false;  // true at the end of a line or turn
};

struct PathCourse {
  PathConfig path{};          // relative to the start position of the tool
  std::vector<PathAim> aims;  // ends of lines and turns, and intermediate targets at most 30 mm or 30° apart
  std::vector<Vector3> drawn_m;  // vertices of a polyline for drawing the path
  double length_m = 0.0;
};

/// Creates a course from the lines and turns of `scene`. All turns of the scene must be right angles.
PathCourse shuffled_course(const PathConfig& scene, Random random);

}  // namespace longreach
