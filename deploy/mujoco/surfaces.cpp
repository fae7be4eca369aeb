#include "deploy/mujoco/surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "deploy/mujoco/mjcf_text.hpp"

namespace longreach {
namespace {

constexpr double kThinnest_m = 5e-4;  // half of what remains of an edge
constexpr double kOff_m = 1e-3;       // distance by which a face may therefore be off
// Of a spring with its block, which is so heavy that MuJoCo's contact is 50 times as stiff as the spring. Behind a heavier
// block, a tool that slides with friction loses and finds the contact in each step.
constexpr double kResponse_s = 0.003;
// Fraction of the critical damping of a spring: with 5 N/mm 5 N s/m, as the materials of the scenes have at 10 N. A spring
// that is damped more is felt softer when it is hit: at 40 mm/s, 15 N s/m take 3 %.
constexpr double kDamping = 0.15;
constexpr double kPhase = 0.3;  // of both in one time step at most, rad: MuJoCo integrates explicitly
/// Stiffness and damping of the contact itself, as in deploy/mujoco/scenes.
constexpr const char* kContact = "-5e5 -800";

std::size_t springs_of(const MujocoSurface& s) { return s.only_x ? 1 : 3; }

void add(tinyxml2::XMLElement& world, const MujocoSurface& s, const MujocoTip& tip, double step_s) {
  const double mass_kg = s.stiffness_n_per_m * std::pow(std::max(kResponse_s, step_s / kPhase), 2);
  const double damping = 2.0 * kDamping * std::sqrt(s.stiffness_n_per_m * mass_kg);
  auto& body = *world.InsertNewChildElement("body");
  const Quaternion& q = s.X_WS.q;
  body.SetAttribute("pos", list_of(s.X_WS.p).c_str());
  body.SetAttribute("quat", list_of(std::vector{q.w(), q.x(), q.y(), q.z()}).c_str());
  for (std::size_t i = 0; i < springs_of(s); ++i) {
    auto& joint = *body.InsertNewChildElement("joint");
    joint.SetAttribute("type", "slide");
    joint.SetAttribute("axis", list_of(Vector3(Vector3::Unit(static_cast<int>(i)))).c_str());
    joint.SetAttribute("stiffness", format_number(s.stiffness_n_per_m).c_str());
    joint.SetAttribute("damping", format_number(damping).c_str());
    joint.SetAttribute("limited", "false");
  }
  auto& geom = *body.InsertNewChildElement("geom");
  geom.SetAttribute("name", ("surface " + s.name).c_str());
  geom.SetAttribute("type", "box");
  geom.SetAttribute("size", list_of(Vector3((s.half_m.array() - tip.radius_m).max(kThinnest_m))).c_str());
  geom.SetAttribute("mass", format_number(mass_kg).c_str());
  // It collides with the tool and with no other surface, and says how.
  geom.SetAttribute("contype", tip.conaffinity);
  geom.SetAttribute("conaffinity", tip.conaffinity == 0 ? tip.contype : 0);
  geom.SetAttribute("priority", 1000);
  geom.SetAttribute("solref", kContact);
  geom.SetAttribute("friction", list_of(tip.friction).c_str());
}

}  // namespace

void add_surfaces(tinyxml2::XMLElement& root, const std::vector<MujocoSurface>& surfaces,
                  const MujocoTip& tip, double step_s) {
  std::vector<double> springs;
  // With pyramids, contacts that are so stiff chatter.
  root.InsertNewChildElement("option")->SetAttribute("cone", "elliptic");
  auto& world = *root.InsertNewChildElement("worldbody");
  for (const MujocoSurface& surface : surfaces) {
    if (surface.half_m.minCoeff() - tip.radius_m < kThinnest_m - kOff_m)
      throw UnsuitableScene(surface.name + ": is thinner than the tool");
    add(world, surface, tip, step_s);
    springs.resize(springs.size() + springs_of(surface));
  }
  continue_keys(root, list_of(springs), list_of(springs));
}

}  // namespace longreach
