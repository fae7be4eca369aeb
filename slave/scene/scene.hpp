#pragma once
// What the tool meets: infinite planes of Hunt-Crossley material (Hunt, Crossley 1975), forces summed,
//   F = max(0, k pⁿ (1 + a v)),   p = n·(point - p_E) > 0,   v = -n·v_E,   k = stiffness /
//   reference_depth^(n-1)
// and 0 without penetration: it never pulls. No friction, no moment; the tool is a point whose motion is
// imposed.

#include <vector>

#include "slave/scene/scene_config.hpp"

namespace longreach {

struct ToolMotion {
  Vector3 p_WE = Vector3::Zero();  // m
  Vector3 v_WE = Vector3::Zero();  // m/s
};

struct SceneContact {
  Vector3 force_n = Vector3::Zero();  // by the scene on the tool, in W
  double depth_m = 0.0;               // of the deepest penetration; 0 without contact
  int surface = -1;                   // index of the deepest surface; -1 without contact
};

class Scene {
 public:
  /// Throws std::invalid_argument if a surface names an unknown material or its normal is not a direction.
  Scene(const SceneConfig& config, const Vector3& tool_start_m);

  [[nodiscard]] bool empty() const { return surfaces_.empty(); }
  [[nodiscard]] SceneContact contact(const ToolMotion& tool) const;

  /// Static F/p of surface `surface` at `depth_m` > 0, N/m; 0 for an index that is none.
  [[nodiscard]] double secant_n_per_m(int surface, double depth_m) const;

 private:
  struct Surface {
    Vector3 point_m, normal;
    double k, n, a;
  };
  std::vector<Surface> surfaces_;
};

}  // namespace longreach
