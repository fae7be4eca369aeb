#include "slave/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace longreach {
namespace {

[[noreturn]] void refuse(const SurfaceConfig& surface, const std::string& why) {
  throw std::invalid_argument("surface \"" + surface.name + "\" " + why);
}

HuntCrossley law_of(const SceneConfig& config, const SurfaceConfig& surface) {
  const auto material = std::ranges::find(config.material, surface.material, &MaterialConfig::name);
  if (material == config.material.end())
    refuse(surface, "names the material \"" + surface.material + "\", which the scene does not have");
  const double k =
      material->stiffness_n_per_m / std::pow(material->reference_depth_m, material->exponent - 1.0);
  return {k, material->exponent, material->damping_s_per_m};
}

Vector3 direction(const SurfaceConfig& surface, const Vector3& v) {
  const double length = v.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
    refuse(surface, "has an axis or a normal without a direction");
  return v / length;
}

Shape shape_of(const SurfaceConfig& surface, const Vector3& start_m) {
  const auto from = [&](bool from_tool_start) { return from_tool_start ? start_m : Vector3::Zero().eval(); };
  if (surface.plane) {
    return HalfSpace{surface.plane->point_m + from(surface.plane->from_tool_start),
                     direction(surface, surface.plane->normal)};
  }
  if (surface.sphere) {
    return Ball{surface.sphere->centre_m + from(surface.sphere->from_tool_start), surface.sphere->radius_m};
  }
  if (surface.box) {
    return Block{surface.box->centre_m + from(surface.box->from_tool_start),
                 exp_rotation(surface.box->rotation_rad).toRotationMatrix(), 0.5 * surface.box->size_m};
  }
  if (!surface.cylinder) refuse(surface, "has no shape");
  return Rod{surface.cylinder->centre_m + from(surface.cylinder->from_tool_start),
             direction(surface, surface.cylinder->axis), surface.cylinder->radius_m,
             0.5 * surface.cylinder->length_m};
}

struct Moved {
  Vector3 by_m, v_m_per_s;
};

Moved moved(const MovementConfig& movement, double t_s) {
  const double w = 2.0 * std::numbers::pi * movement.frequency_hz;
  return {movement.velocity_m_per_s * t_s + movement.amplitude_m * std::sin(w * t_s),
          movement.velocity_m_per_s + movement.amplitude_m * (w * std::cos(w * t_s))};
}

void deepest(SceneContact& result, int surface, double depth_m, const Vector3& normal) {
  ++result.contacts;
  if (!(depth_m > result.depth_m)) return;
  result.depth_m = depth_m;
  result.surface = surface;
  result.normal = normal;
}

}  // namespace

NeedsConfig needs(const SceneConfig& scene) {
  if (scene.needs) return *scene.needs;
  NeedsConfig all;
  for (const SurfaceConfig& surface : scene.surface) (surface.hinge ? all.rotation : all.contact) = true;
  return all;
}

Scene::Scene(const SceneConfig& config, const Pose& X_WE_start)
    : tool_radius_m_(config.tool_radius_m), q_start_(X_WE_start.q) {
  std::map<std::string, std::size_t> known;  // bodies by name
  for (std::size_t i = 0; i < config.surface.size(); ++i) {
    const SurfaceConfig& surface = config.surface[i];
    const int index = static_cast<int>(i);
    laws_.push_back(law_of(config, surface));
    if (surface.hinge) {
      hinges_.push_back({laws_.back(), direction(surface, surface.hinge->axis), surface.hinge->angle_rad,
                         surface.hinge->arm_m, index});
      continue;
    }
    const auto [place, first] =
        surface.body.empty() ? std::pair{known.end(), true} : known.try_emplace(surface.body, bodies_.size());
    if (first) bodies_.push_back({laws_.back(), {}});
    Body& body = first ? bodies_.back() : bodies_[place->second];
    body.parts.push_back({shape_of(surface, X_WE_start.p), surface.movement.value_or(MovementConfig{}),
                          surface.movement.has_value(), index});
  }
  plant_tree();
}

void Scene::plant_tree() {
  std::vector<Bounds> finite;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const std::vector<Part>& parts = bodies_[i].parts;
    Bounds all = bounds(parts.front().shape);
    bool rests = true;
    for (const Part& part : parts) {
      all = all.with(bounds(part.shape));
      rests = rests && !part.moves;
    }
    (rests && all.finite() ? in_tree_ : always_).push_back(i);
    if (rests && all.finite()) finite.push_back(all);
  }
  tree_ = BoundsTree(finite);
}

SceneContact Scene::contact(const ToolMotion& tool) const {
  SceneContact result;
  for (const std::uint32_t i : always_) touch(bodies_[i], tool, result);
  tree_.find(tool.p_WE, tool_radius_m_,
             [&](std::uint32_t found) { touch(bodies_[in_tree_[found]], tool, result); });
  for (const Hinge& hinge : hinges_) turn(hinge, tool, result);
  return result;
}

void Scene::touch(const Body& body, const ToolMotion& tool, SceneContact& result) const {
  double depth = 0.0, rate = 0.0;
  Vector3 normal;
  int surface = -1;
  for (const Part& part : body.parts) {
    const Moved by = part.moves ? moved(part.movement, tool.t_s) : Moved{Vector3::Zero(), Vector3::Zero()};
    const Side near = side(part.shape, tool.p_WE - by.by_m);
    ++result.asked;
    if (!(tool_radius_m_ - near.distance_m > depth)) continue;
    depth = tool_radius_m_ - near.distance_m;
    rate = near.normal.dot(by.v_m_per_s - tool.v_WE);
    normal = near.normal;
    surface = part.surface;
  }
  if (surface < 0) return;
  result.force_n += body.law.force_n(depth, rate) * normal;
  deepest(result, surface, depth, normal);
}

// The twist of the turn since the start about the axis (swing and twist), and its derivative.
void Scene::turn(const Hinge& hinge, const ToolMotion& tool, SceneContact& result) const {
  const Quaternion q = tool.q_WE * q_start_.conjugate();
  const double w = q.w() < 0.0 ? -q.w() : q.w();
  const Vector3 v = q.w() < 0.0 ? Vector3(-q.vec()) : q.vec();
  const double along = hinge.axis.dot(v);
  ++result.asked;
  const double depth = hinge.arm_m * (2.0 * std::atan2(along, w) - hinge.angle_rad);
  if (!(depth > 0.0)) return;
  const Vector3 gradient =
      (w * w * hinge.axis + w * v.cross(hinge.axis) + along * v) / (w * w + along * along);
  const double rate = hinge.arm_m * gradient.dot(tool.w_WE);
  result.moment_nm -= hinge.law.force_n(depth, rate) * hinge.arm_m * gradient;
  deepest(result, hinge.surface, depth, Vector3::Zero());
}

double Scene::secant_n_per_m(int surface, double depth_m) const {
  if (surface < 0 || static_cast<std::size_t>(surface) >= laws_.size()) return 0.0;
  return laws_[static_cast<std::size_t>(surface)].secant_n_per_m(depth_m);
}

}  // namespace longreach
