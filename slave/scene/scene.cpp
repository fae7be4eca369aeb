#include "slave/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace longreach {

Scene::Scene(const SceneConfig& config, const Vector3& tool_start_m) {
  surfaces_.reserve(config.surface.size());
  for (const SurfaceConfig& surface : config.surface) {
    const auto material =
        std::find_if(config.material.begin(), config.material.end(),
                     [&](const MaterialConfig& candidate) { return candidate.name == surface.material; });
    if (material == config.material.end()) {
      throw std::invalid_argument("surface \"" + surface.name + "\" names the material \"" +
                                  surface.material + "\", which the scene does not have");
    }
    const double length = surface.plane.normal.stableNorm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw std::invalid_argument("surface \"" + surface.name + "\" has a normal without a direction");
    }
    const Vector3 offset = surface.plane.from_tool_start ? tool_start_m : Vector3::Zero();
    const double k =
        material->stiffness_n_per_m / std::pow(material->reference_depth_m, material->exponent - 1.0);
    surfaces_.push_back({surface.plane.point_m + offset, surface.plane.normal / length, k, material->exponent,
                         material->damping_s_per_m});
  }
}

SceneContact Scene::contact(const ToolMotion& tool) const {
  SceneContact result;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const Surface& s = surfaces_[i];
    const double depth = s.normal.dot(s.point_m - tool.p_WE);
    if (!(depth > 0.0)) continue;
    const double inward = -s.normal.dot(tool.v_WE);
    const double force = s.k * std::pow(depth, s.n) * (1.0 + s.a * inward);
    if (force > 0.0) result.force_n += force * s.normal;
    if (depth > result.depth_m) {
      result.depth_m = depth;
      result.surface = static_cast<int>(i);
    }
  }
  return result;
}

double Scene::secant_n_per_m(int surface, double depth_m) const {
  if (surface < 0 || static_cast<std::size_t>(surface) >= surfaces_.size()) return 0.0;
  const Surface& s = surfaces_[static_cast<std::size_t>(surface)];
  return s.k * std::pow(depth_m, s.n - 1.0);
}

}  // namespace longreach
