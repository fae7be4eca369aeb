#pragma once
// What the robot can meet, as the scene's file describes it.

#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Hunt-Crossley F = k p^n (1 + a v); stiffness is the secant F/p at the reference depth.
struct MaterialConfig {
  std::string name;
  double stiffness_n_per_m = 1000.0;
  double reference_depth_m = 0.001;
  double exponent = 1.0;
  double damping_s_per_m = 0.1;  // a = lambda/k
};

/// Infinite plane; the solid lies behind it.
struct PlaneConfig {
  Vector3 point_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitX();  // outward; need not be unit
  bool from_tool_start = true;         // the point is measured from where the tool starts
};

struct SurfaceConfig {
  std::string name;
  std::string material;  // by name
  PlaneConfig plane{};
};

struct SceneConfig {
  std::string name;
  std::vector<MaterialConfig> material;
  std::vector<SurfaceConfig> surface;
};

}  // namespace longreach
