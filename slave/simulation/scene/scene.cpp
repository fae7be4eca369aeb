#include "slave/simulation/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "slave/config/path.hpp"

namespace longreach {
namespace {

[[noreturn]] void refuse(const SurfaceConfig& surface, const std::string& why) {
  throw std::invalid_argument("surface \"" + surface.name + "\" " + why);
}

HuntCrossley law_of(const SceneConfig& config, const SurfaceConfig& surface) {
  const auto material = std::ranges::find(config.material, surface.material, &MaterialConfig::name);
  if (material == config.material.end())
    refuse(surface, "names the material \"" + surface.material + "\", which the scene does not define");
  const double k =
      material->stiffness_n_per_m / std::pow(material->reference_depth_m, material->exponent - 1.0);
  return {k, material->exponent, material->damping_s_per_m};
}

Vector3 direction(const SurfaceConfig& surface, const Vector3& v) {
  const double length = v.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length)) refuse(surface, "has an axis or a normal of length zero");
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

Scene::Scene(const SceneConfig& config, const Pose& X_WE_start)
    : tool_radius_m_(config.tool_radius_m), q_start_(X_WE_start.q) {
  if (config.path) static_cast<void>(Path(*config.path, X_WE_start.p));  // refuses one that is none
  std::map<std::string, std::size_t> known;                              // bodies by name
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

template <class Visit>
void Scene::near(const Vector3& p, double reach_m, Visit&& visit) const {
  for (const std::uint32_t i : always_) visit(bodies_[i]);
  tree_.find(p, tool_radius_m_ + reach_m, [&](std::uint32_t found) { visit(bodies_[in_tree_[found]]); });
}

SceneContact Scene::contact(const ToolMotion& tool) const {
  SceneContact result;
  near(tool.p_WE, 0.0, [&](const Body& body) {
    const Nearest at = nearest(body, tool);
    result.asked += static_cast<int>(body.parts.size());
    if (!(at.depth_m > 0.0)) return;
    const double rate = at.gradient.dot(tool.v_WE - at.v_m_per_s);
    result.force_n -= body.law.force_n(at.depth_m, rate) * at.gradient;
    deepest(result, at.surface, at.depth_m, -at.gradient);
  });
  for (const Hinge& hinge : hinges_) {
    const Nearest at = nearest(hinge, tool);
    ++result.asked;
    if (!(at.depth_m > 0.0)) continue;
    result.moment_nm -= hinge.law.force_n(at.depth_m, at.gradient.dot(tool.w_WE)) * at.gradient;
    deepest(result, at.surface, at.depth_m, Vector3::Zero());
  }
  return result;
}

Scene::Nearest Scene::nearest(const Body& body, const ToolMotion& tool) const {
  Nearest result{-std::numeric_limits<double>::infinity(), -Vector3::UnitZ(), Vector3::Zero(),
                 Vector3::Zero(), -1};
  for (const Part& part : body.parts) {
    const Moved by = part.moves ? moved(part.movement, tool.t_s) : Moved{Vector3::Zero(), Vector3::Zero()};
    const SurfaceSide out = side(part.shape, tool.p_WE - by.by_m);
    const double depth = tool_radius_m_ - out.distance_m;
    if (depth > result.depth_m) result = {depth, -out.normal, by.by_m, by.v_m_per_s, part.surface};
  }
  return result;
}

// The twist of the turn since the start about the axis (swing and twist), and its derivative.
Scene::Nearest Scene::nearest(const Hinge& hinge, const ToolMotion& tool) const {
  const Quaternion q = tool.q_WE * q_start_.conjugate();
  const double w = q.w() < 0.0 ? -q.w() : q.w();
  const Vector3 v = q.w() < 0.0 ? Vector3(-q.vec()) : q.vec();
  const double along = hinge.axis.dot(v);
  const Vector3 twist = (w * w * hinge.axis + w * v.cross(hinge.axis) + along * v) / (w * w + along * along);
  return {hinge.arm_m * (2.0 * std::atan2(along, w) - hinge.angle_rad), hinge.arm_m * twist, Vector3::Zero(),
          Vector3::Zero(), hinge.surface};
}

SceneMean Scene::mean_contact(const ToolMotion& from, const ToolMotion& to, double dt) const {
  SceneMean mean;
  const auto add = [&](const HuntCrossley& law, const Nearest& before, const Nearest& after,
                       const Vector3& way, int rows) {
    const double change = after.depth_m - before.depth_m;
    const double damping = 1.0 + law.a * change / dt;
    const auto [elastic, slope] = law.mean_elastic(before.depth_m, change);
    if (!(elastic * damping > 0.0)) return;
    Vector3 along = 0.5 * (before.gradient + after.gradient);
    const double length2 = way.squaredNorm();
    if (length2 > 0.0) along += (change - along.dot(way)) / length2 * way;
    mean.wrench.segment<3>(rows) -= elastic * damping * along;
    const double stiffness = slope * damping + elastic * law.a / dt;
    mean.stiffness.block<3, 3>(rows, rows) += stiffness * along * along.transpose();
  };
  const Vector3 way = to.p_WE - from.p_WE;
  near(from.p_WE, way.norm(), [&](const Body& body) {
    const Nearest before = nearest(body, from), after = nearest(body, to);
    add(body.law, before, after, way - (after.by_m - before.by_m), 3);
  });
  const Vector3 turn = hinges_.empty() ? Vector3::Zero() : log_rotation(to.q_WE * from.q_WE.conjugate());
  for (const Hinge& hinge : hinges_) add(hinge.law, nearest(hinge, from), nearest(hinge, to), turn, 0);
  return mean;
}

double Scene::secant_n_per_m(int surface, double depth_m) const {
  if (surface < 0 || static_cast<std::size_t>(surface) >= laws_.size()) return 0.0;
  return laws_[static_cast<std::size_t>(surface)].secant_n_per_m(depth_m);
}

}  // namespace longreach
