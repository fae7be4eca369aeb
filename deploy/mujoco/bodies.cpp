#include "deploy/mujoco/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "deploy/mujoco/mjcf_text.hpp"
#include "deploy/mujoco/numbers.hpp"
#include "deploy/mujoco/surfaces.hpp"

namespace longreach {
namespace {

constexpr const char* kToolBody = "tool";
constexpr double kContactDamping = 0.1;  // fraction of the critical one
// Impedances of MuJoCo. The smaller, the more a constraint is a spring; the larger, the more it is rigid.
constexpr double kOfContact = 0.1, kOfGrasp = 0.9;

std::unique_ptr<mjModel, void (*)(mjModel*)> load_bodies(const BodiesConfig& config) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  for (const SceneFileConfig& file : config.file) {
    const std::string name = file.name.substr(file.name.rfind('/') + 1);
    if (mj_makeEmptyFileVFS(files.get(), name.c_str(), static_cast<int>(file.text.size())) != 0)
      throw std::invalid_argument(config.mjcf_file + ": the file " + name + " is named twice");
    file.text.copy(static_cast<char*>(files->filedata[files->nfile - 1]), file.text.size());
  }
  std::array<char, 1000> error{};
  const std::string first = config.file.empty() ? std::string() : config.file.front().name;
  mjModel* model = mj_loadXML(first.substr(first.rfind('/') + 1).c_str(), files.get(), error.data(),
                              static_cast<int>(error.size()));
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::invalid_argument(config.mjcf_file + ": " + error.data());
  return {model, mj_deleteModel};
}

/// For a body whose geoms have no mass.
void add_no_mass(tinyxml2::XMLElement& body) {
  auto& inertial = *body.InsertNewChildElement("inertial");
  inertial.SetAttribute("pos", "0 0 0");
  inertial.SetAttribute("mass", "1e-9");
  inertial.SetAttribute("diaginertia", "1e-12 1e-12 1e-12");
}

void set_pose(tinyxml2::XMLElement& element, const Pose& X) {
  element.SetAttribute("pos", list_of(X.p).c_str());
  element.SetAttribute("quat", list_of(std::array{X.q.w(), X.q.x(), X.q.y(), X.q.z()}).c_str());
}

/// The body that contains the site of this name.
tinyxml2::XMLElement* body_of_site(tinyxml2::XMLElement& in, const std::string& site) {
  for (auto* child = in.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string kind = child->Name();
    const char* const name = child->Attribute("name");
    if (kind == "site" && name != nullptr && site == name) return &in;
    if (kind != "body" && kind != "worldbody") continue;
    if (auto* found = body_of_site(*child, site)) return found;
  }
  return nullptr;
}

/// Parameters for which a constraint is a spring: with the inverse mass `w` that MuJoCo estimates for it (diagApprox), its
/// force at rest is k times the depth.
void set_spring(mjtNum* solref, mjtNum* solimp, double impedance, double k, double b, double w) {
  solref[0] = -k * (1.0 - impedance) * w;
  solref[1] = -b * (1.0 - impedance) * w;
  solimp[0] = solimp[1] = impedance;
}

double inverse_mass(const mjModel& m, int body_a, int body_b) {
  return m.body_invweight0[2 * body_a] + m.body_invweight0[2 * body_b];
}

}  // namespace

MujocoBodies::MujocoBodies(const SceneConfig& scene, const Pose& X_WE_start)
    : scene_(scene), X_WE_start_(X_WE_start), model_(load_bodies(*scene.bodies)) {
  take_bodies();
  take_geoms();
}

std::string MujocoBodies::name(mjtObj kind, int number) const {
  const char* text = mj_id2name(model_.get(), kind, number);
  return text != nullptr ? text : std::to_string(kind) + " " + std::to_string(number);
}

// What longreach's own bodies require is checked where a scene is read (CollisionModel).
void MujocoBodies::take_bodies() {
  for (int b = 1; b < model_->nbody; ++b) {
    if (model_->body_jntnum[b] == 0) continue;
    if (name(mjOBJ_BODY, b) == kToolBody) {
      tool_ = b;
    } else {
      free_.push_back(b);
    }
  }
  if (tool_ < 0) throw std::invalid_argument(scene_.bodies->mjcf_file + ": has no body \"tool\"");
}

void MujocoBodies::take_geoms() {
  const mjModel& m = *model_;
  for (int g = 0; g < m.ngeom; ++g) {
    if (m.geom_contype[g] == 0 && m.geom_conaffinity[g] == 0) continue;
    const int kind = m.geom_type[g];
    if (kind == mjGEOM_MESH || kind == mjGEOM_PLANE || kind == mjGEOM_HFIELD)
      throw UnsuitableScene(name(mjOBJ_GEOM, g) + ": is neither a sphere, a box nor another simple body");
    const std::string of = m.geom_matid[g] < 0 ? "" : name(mjOBJ_MATERIAL, m.geom_matid[g]);
    const auto material = std::ranges::find(scene_.material, of, &MaterialConfig::name);
    if (material == scene_.material.end())
      throw std::invalid_argument(scene_.bodies->mjcf_file + ": the geom " + name(mjOBJ_GEOM, g) +
                                  " has no material of the scene");
    geom_.push_back(
        {g, m.body_weldid[m.geom_bodyid[g]], static_cast<int>(material - scene_.material.begin())});
  }
}

bool MujocoBodies::meet(const Geom& a, const Geom& b) const {
  const mjModel& m = *model_;
  return a.body != b.body && ((m.geom_contype[a.number] & m.geom_conaffinity[b.number]) != 0 ||
                              (m.geom_contype[b.number] & m.geom_conaffinity[a.number]) != 0);
}

void MujocoBodies::add_geoms(tinyxml2::XMLElement& to, int body) const {
  constexpr std::array<const char*, 7> kKind{"plane",     "hfield",   "sphere", "capsule",
                                             "ellipsoid", "cylinder", "box"};
  const mjModel& m = *model_;
  for (const Geom& g : geom_) {
    if (g.body != body) continue;
    auto& geom = *to.InsertNewChildElement("geom");
    geom.SetAttribute("name", scene_name(name(mjOBJ_GEOM, g.number)).c_str());
    geom.SetAttribute("type", kKind[static_cast<std::size_t>(m.geom_type[g.number])]);
    geom.SetAttribute("size", list_of(vector_at(m.geom_size + 3 * g.number)).c_str());
    Pose X = pose_at(m.geom_pos + 3 * g.number, m.geom_quat + 4 * g.number);
    const int own = m.geom_bodyid[g.number];
    if (own != body) X = pose_at(m.body_pos + 3 * own, m.body_quat + 4 * own) * X;  // at rest in the world
    set_pose(geom, X);
    geom.SetAttribute("mass", 0);
    // It collides by pairs alone.
    geom.SetAttribute("contype", 0);
    geom.SetAttribute("conaffinity", 0);
  }
}

void MujocoBodies::add_pairs(tinyxml2::XMLElement& root, double sliding) const {
  auto& contact = *root.InsertNewChildElement("contact");
  for (std::size_t i = 0; i < geom_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!meet(geom_[i], geom_[j])) continue;
      auto& pair = *contact.InsertNewChildElement("pair");
      pair.SetAttribute("geom1", scene_name(name(mjOBJ_GEOM, geom_[j].number)).c_str());
      pair.SetAttribute("geom2", scene_name(name(mjOBJ_GEOM, geom_[i].number)).c_str());
      pair.SetAttribute("condim", sliding > 0.0 ? 3 : 1);
      pair.SetAttribute("friction", list_of(std::array{sliding, sliding, 0.0, 0.0, 0.0}).c_str());
    }
}

void MujocoBodies::add(tinyxml2::XMLElement& root, const std::string& site, const Pose& X_TE,
                       double sliding) const {
  const mjModel& m = *model_;
  root.InsertNewChildElement("option")->SetAttribute("cone", "elliptic");
  auto& size = *root.InsertNewChildElement("size");
  size.SetAttribute("nconmax", 500);  // MuJoCo drops what has no room
  size.SetAttribute("njmax", 3000);
  auto& tool = *body_of_site(root, site)->InsertNewChildElement("body");
  tool.SetAttribute("name", scene_name(kToolBody).c_str());
  set_pose(tool, X_TE * Pose{Vector3::Zero(), X_WE_start_.q.conjugate()});
  add_no_mass(tool);
  add_geoms(tool, tool_);
  auto& world = *root.InsertNewChildElement("worldbody");
  const Pose X_WS{X_WE_start_.p, Quaternion::Identity()};
  auto& rest = *world.InsertNewChildElement("body");
  rest.SetAttribute("name", scene_name("world").c_str());
  set_pose(rest, X_WS);
  add_no_mass(rest);
  add_geoms(rest, 0);
  std::vector<double> positions, speeds;
  const int fixture =
      scene_.bodies->gripper ? mj_name2id(&m, mjOBJ_SITE, scene_.bodies->gripper->fixture.c_str()) : -1;
  for (const int b : free_) {
    auto& body = *world.InsertNewChildElement("body");
    body.SetAttribute("name", scene_name(name(mjOBJ_BODY, b)).c_str());
    const Pose X = X_WS * pose_at(m.body_pos + 3 * b, m.body_quat + 4 * b);
    set_pose(body, X);
    for (const double x : {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()})
      positions.push_back(x);
    speeds.resize(speeds.size() + 6);
    body.InsertNewChildElement("freejoint");
    auto& inertial = *body.InsertNewChildElement("inertial");
    set_pose(inertial, pose_at(m.body_ipos + 3 * b, m.body_iquat + 4 * b));
    inertial.SetAttribute("mass", format_number(m.body_mass[b]).c_str());
    inertial.SetAttribute("diaginertia", list_of(vector_at(m.body_inertia + 3 * b)).c_str());
    add_geoms(body, b);
    if (fixture < 0 || m.site_bodyid[fixture] != b) continue;
    auto& site_of_body = *body.InsertNewChildElement("site");
    site_of_body.SetAttribute("name", scene_name(scene_.bodies->gripper->fixture).c_str());
    set_pose(site_of_body, pose_at(m.site_pos + 3 * fixture, m.site_quat + 4 * fixture));
  }
  add_pairs(root, sliding);
  if (scene_.bodies->gripper) {
    auto& weld = *root.InsertNewChildElement("equality")->InsertNewChildElement("weld");
    weld.SetAttribute("name", scene_name("grasp").c_str());
    weld.SetAttribute("body1", scene_name(kToolBody).c_str());
    weld.SetAttribute(
        "body2", scene_name(name(mjOBJ_BODY, fixture < 0 ? free_.front() : m.site_bodyid[fixture])).c_str());
    weld.SetAttribute("active", "false");
  }
  continue_keys(root, list_of(positions), list_of(speeds));
}

void MujocoBodies::set_laws(mjModel& model) const {
  const auto material_of = [&](int geom) -> const MaterialConfig* {
    for (const Geom& g : geom_)
      if (mj_name2id(&model, mjOBJ_GEOM, scene_name(name(mjOBJ_GEOM, g.number)).c_str()) == geom)
        return &scene_.material[static_cast<std::size_t>(g.material)];
    return nullptr;
  };
  for (int i = 0; i < model.npair; ++i) {
    const int a = model.pair_geom1[i], b = model.pair_geom2[i];
    const MaterialConfig *of_a = material_of(a), *of_b = material_of(b);
    if (of_a == nullptr || of_b == nullptr) continue;
    const double w = inverse_mass(model, model.geom_bodyid[a], model.geom_bodyid[b]);
    const double k = std::min(of_a->stiffness_n_per_m, of_b->stiffness_n_per_m);
    const double damping = 2.0 * kContactDamping * std::sqrt(k / w);
    set_spring(model.pair_solref + mjNREF * i, model.pair_solimp + mjNIMP * i, kOfContact, k, damping, w);
  }
  const int grasp = mj_name2id(&model, mjOBJ_EQUALITY, scene_name("grasp").c_str());
  if (grasp < 0) return;
  const BondConfig& bond = scene_.bodies->gripper->bond;
  set_spring(model.eq_solref + mjNREF * grasp, model.eq_solimp + mjNIMP * grasp, kOfGrasp,
             bond.stiffness_n_per_m, bond.damping_n_s_per_m,
             inverse_mass(model, model.eq_obj1id[grasp], model.eq_obj2id[grasp]));
}

}  // namespace longreach
