#pragma once
// Surfaces that are added to an MJCF file: plates and blocks on springs, which the laboratory puts in front of a robot that
// MuJoCo simulates (robot.mjcf).

#include <stdexcept>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace longreach {

/// Something that cannot be put in front of a robot of an MJCF file. The message names the surface and the reason.
class UnsuitableScene : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A block on springs along its axes. The tool must be a sphere around the site; the block is smaller by its radius, so
/// that the tool touches it when the site reaches the face.
struct MujocoSurface {
  std::string name;
  Pose X_WS{};                        // centre and axes of the block, in W
  Vector3 half_m = Vector3::Ones();   // half of the lengths of its edges
  bool only_x = false;                // yields along its x axis alone, like a wall whose face is large
  double stiffness_n_per_m = 1000.0;  // of each spring
};

/// How the tool collides with the surfaces: the only geom of its bodies that does, a sphere around the site.
struct MujocoTip {
  double radius_m = 0.0;
  int contype = 0, conaffinity = 0;
  /// Sliding, torsional, rolling: of the geom, or the sliding friction of the file's numeric "surface_friction".
  Vector3 friction = Vector3::Zero();
};

/// Adds surfaces at the end of an MJCF file without <include>. Key frames are continued with zeros for their springs, and
/// friction cones are elliptic. `step_s`: time step of the file. Throws UnsuitableScene if a surface is so thin that a face
/// would be more than 1 mm off.
void add_surfaces(tinyxml2::XMLElement& root, const std::vector<MujocoSurface>& surfaces,
                  const MujocoTip& tip, double step_s);

}  // namespace longreach
