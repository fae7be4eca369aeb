#include "slave/simulation/scene/collision_model.hpp"

#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace longreach {
namespace {

constexpr char kLibrary[] = "libmujoco.so.2.2.2";
constexpr char kTool[] = "tool";

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw std::invalid_argument(file + ": " + why);
}

void be_silent(const char*) {}

// The functions that are used of the library, which stays in the process once it is there.
struct Library {
  decltype(&mj_loadXML) load_xml;
  decltype(&mj_deleteModel) delete_model;
  decltype(&mj_makeData) make_state;
  decltype(&mj_deleteData) delete_state;
  decltype(&mj_kinematics) kinematics;
  decltype(&mj_collision) collision;
  decltype(&mj_name2id) number_of;
  decltype(&mj_id2name) name_of;
  decltype(&mj_defaultVFS) empty_files;
  decltype(&mj_makeEmptyFileVFS) make_file;
  decltype(&mj_deleteVFS) delete_files;

  Library() {
    void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw std::invalid_argument(std::string("a scene with bodies needs MuJoCo, but ") + kLibrary +
                                  " cannot be loaded; install libmujoco2.2.2 (deploy/setup)");
    const auto take = [library](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr) throw std::invalid_argument(std::string(kLibrary) + " has no " + name);
    };
    take(load_xml, "mj_loadXML");
    take(delete_model, "mj_deleteModel");
    take(make_state, "mj_makeData");
    take(delete_state, "mj_deleteData");
    take(kinematics, "mj_kinematics");
    take(collision, "mj_collision");
    take(number_of, "mj_name2id");
    take(name_of, "mj_id2name");
    take(empty_files, "mj_defaultVFS");
    take(make_file, "mj_makeEmptyFileVFS");
    take(delete_files, "mj_deleteVFS");
    // By default it would write a file into the working folder.
    decltype(&mju_user_warning) warning = nullptr;
    take(warning, "mju_user_warning");
    *warning = be_silent;
  }
};

const Library& library() {
  static const Library once;
  return once;
}

Vector3 vector(const mjtNum* v) { return {v[0], v[1], v[2]}; }
Quaternion rotation(const mjtNum* q) { return {q[0], q[1], q[2], q[3]}; }
Pose pose(const mjtNum* p, const mjtNum* q) { return {vector(p), rotation(q)}; }

// MuJoCo says "XML Error: ... Element 'geom', line 12, column 5": the place goes to the front.
std::string with_line(const std::string& file, std::string error) {
  std::replace(error.begin(), error.end(), '\n', ' ');
  while (!error.empty() && error.back() == ' ') error.pop_back();
  const std::size_t at = error.find("line ");
  const std::size_t end = at == std::string::npos ? at : error.find_first_not_of("0123456789", at + 5);
  if (at == std::string::npos || end == at + 5) return file + ": " + error;
  return file + ":" + error.substr(at + 5, end - at - 5) + ": " + error;
}

}  // namespace

struct CollisionModel::Engine {
  const Library& mujoco = library();
  mjModel* model = nullptr;
  mjData* state = nullptr;
  std::vector<int> place;  // in qpos, of each free body and then the tool
  std::vector<Pose> X_IB;  // body frame in the inertial frame, likewise

  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine() {
    if (state != nullptr) mujoco.delete_state(state);
    if (model != nullptr) mujoco.delete_model(model);
  }

  void load(const BodiesConfig& config) {
    const auto files = std::make_unique<mjVFS>();
    mujoco.empty_files(files.get());
    for (const SceneFileConfig& file : config.file) {
      const auto name = file.name.substr(file.name.rfind('/') + 1);
      if (mujoco.make_file(files.get(), name.c_str(), static_cast<int>(file.text.size())) != 0)
        refuse(config.mjcf_file, "the file " + name + " is named twice");
      std::memcpy(files->filedata[files->nfile - 1], file.text.data(), file.text.size());
    }
    std::array<char, 1000> error{};
    const std::string first = config.file.empty() ? std::string() : config.file.front().name;
    const auto name = first.substr(first.rfind('/') + 1);
    model = mujoco.load_xml(name.c_str(), files.get(), error.data(), static_cast<int>(error.size()));
    mujoco.delete_files(files.get());
    if (model == nullptr) throw std::invalid_argument(with_line(config.mjcf_file, error.data()));
    make_room(config.mjcf_file);
    state = mujoco.make_state(model);
    for (int g = 0; g < model->ngeom; ++g) {
      model->geom_margin[g] = kNearM;
      model->geom_gap[g] = 0.0;
    }
    // Of the distances of convex shapes.
    model->opt.mpr_tolerance = 1e-12;
    model->opt.mpr_iterations = 200;
  }

  // For all contacts that any pose can have, whatever the file says: MuJoCo omits what has no room.
  void make_room(const std::string& file) {
    int pairs = 0;
    for (int a = 0; a < model->ngeom; ++a) {
      for (int b = 0; b < a; ++b) {
        const bool find_contacts = (model->geom_contype[a] & model->geom_conaffinity[b]) != 0 ||
                                   (model->geom_contype[b] & model->geom_conaffinity[a]) != 0;
        if (find_contacts &&
            model->body_weldid[model->geom_bodyid[a]] != model->body_weldid[model->geom_bodyid[b]])
          ++pairs;
      }
    }
    if (pairs > kPairsMax)
      refuse(file, "has " + std::to_string(pairs) + " pairs of geoms that may touch; at most " +
                       std::to_string(kPairsMax) +
                       " are supported: exclude pairs with contype and conaffinity");
    model->nconmax = pairs * mjMAXCONPAIR;
  }

  void put(std::size_t i, const Pose& X_WI) {
    const Pose X = X_WI * X_IB[i];
    mjtNum* q = state->qpos + place[i];
    for (int k = 0; k < 3; ++k) q[k] = X.p[k];
    q[3] = X.q.w(), q[4] = X.q.x(), q[5] = X.q.y(), q[6] = X.q.z();
  }

  [[nodiscard]] std::string name(mjtObj type, int number) const {
    const char* text = mujoco.name_of(model, type, number);
    return text == nullptr || *text == '\0' ? "number " + std::to_string(number) : text;
  }
};

CollisionModel::CollisionModel(const SceneConfig& scene) : file_(scene.bodies->mjcf_file) {
  engine_ = std::make_unique<Engine>();
  engine_->load(*scene.bodies);
  take_bodies();
  take_laws(scene);
  pairs_.reserve(static_cast<std::size_t>(engine_->model->ngeom * (engine_->model->ngeom - 1) / 2 + 1));
}

CollisionModel::~CollisionModel() = default;
CollisionModel::CollisionModel(CollisionModel&&) noexcept = default;

void CollisionModel::take_bodies() {
  const mjModel& m = *engine_->model;
  std::vector<int> number(static_cast<std::size_t>(m.nbody), -1);
  int tool_body = -1;
  for (int b = 1; b < m.nbody; ++b) {
    const std::string name = engine_->name(mjOBJ_BODY, b);
    if (m.body_jntnum[b] == 0 && m.body_weldid[b] == 0) continue;  // rests in the world
    const int joint = m.body_jntadr[b];
    if (m.body_parentid[b] != 0 || m.body_jntnum[b] != 1 || m.jnt_type[joint] != mjJNT_FREE)
      refuse(file_,
             "the body \"" + name +
                 "\" is neither free nor fixed; give it a freejoint or no joint, and no moving parent");
    if (name == kTool) {
      tool_body = b;
      continue;
    }
    const Pose X_BI = pose(m.body_ipos + 3 * b, m.body_iquat + 4 * b);
    number[static_cast<std::size_t>(b)] = static_cast<int>(bodies_.size());
    bodies_.push_back({name,
                       {m.body_mass[b], vector(m.body_inertia + 3 * b), vector(m.opt.gravity)},
                       pose(m.body_pos + 3 * b, m.body_quat + 4 * b) * X_BI,
                       X_BI});
    engine_->place.push_back(m.jnt_qposadr[joint]);
    engine_->X_IB.push_back(inverse(X_BI));
  }
  if (tool_body < 0)
    refuse(file_, "has no body \"tool\" with a freejoint to represent the parts that move with the tool");
  if (bodies_.empty() || bodies_.size() > kBodiesMax)
    refuse(file_, "has " + std::to_string(bodies_.size()) + " free bodies in addition to the tool; 1 to " +
                      std::to_string(kBodiesMax) + " are supported");
  number[static_cast<std::size_t>(tool_body)] = tool();
  engine_->place.push_back(m.jnt_qposadr[m.body_jntadr[tool_body]]);
  engine_->X_IB.push_back(Pose{});
  reach_m_.resize(bodies_.size() + 1);
  for (int g = 0; g < m.ngeom; ++g) {
    const int body = number[static_cast<std::size_t>(m.geom_bodyid[g])];
    body_of_geom_.push_back(body < 0 ? world() : body);
    if (body < 0) continue;
    const auto b = static_cast<std::size_t>(body);
    const Vector3 centre = vector(m.geom_pos + 3 * g) - inverse(engine_->X_IB[b]).p;
    reach_m_[b] = std::max(reach_m_[b], centre.norm() + m.geom_rbound[g]);
  }
}

void CollisionModel::take_laws(const SceneConfig& scene) {
  const mjModel& m = *engine_->model;
  for (int g = 0; g < m.ngeom; ++g) {
    laws_.emplace_back();
    stiffness_.push_back(0.0);
    if (m.geom_contype[g] == 0 && m.geom_conaffinity[g] == 0) continue;
    const std::string name = m.geom_matid[g] < 0 ? "" : engine_->name(mjOBJ_MATERIAL, m.geom_matid[g]);
    const auto material = std::ranges::find(scene.material, name, &MaterialConfig::name);
    if (material == scene.material.end())
      refuse(file_,
             "the geom \"" + engine_->name(mjOBJ_GEOM, g) + "\" " +
                 (name.empty() ? "has no material"
                               : "has the material \"" + name + "\", which the scene does not define") +
                 "; set material=\"NAME\" to a material of the scene and add <asset><material "
                 "name=\"NAME\"/></asset>, "
                 "or exclude the geom from contact with contype=\"0\" conaffinity=\"0\"");
    const double k =
        material->stiffness_n_per_m / std::pow(material->reference_depth_m, material->exponent - 1.0);
    laws_.back() = {k, material->exponent, material->damping_s_per_m};
    stiffness_.back() = material->stiffness_n_per_m;
  }
}

std::span<const GeomPair> CollisionModel::near(std::span<const Pose> X, const Pose& X_tool) {
  for (std::size_t i = 0; i < X.size(); ++i) engine_->put(i, X[i]);
  engine_->put(X.size(), X_tool);
  engine_->mujoco.kinematics(engine_->model, engine_->state);
  engine_->mujoco.collision(engine_->model, engine_->state);
  pairs_.clear();
  for (int i = 0; i < engine_->state->ncon; ++i) {
    const mjContact& c = engine_->state->contact[i];
    const bool swapped = c.geom1 > c.geom2;
    GeomPair pair{std::min(c.geom1, c.geom2), std::max(c.geom1, c.geom2), 0, 0, {}};
    pair.surface_pair = {-c.dist, vector(c.pos), vector(c.frame)};
    if (swapped) pair.surface_pair.normal *= -1.0;
    const auto same = std::ranges::find_if(
        pairs_, [&pair](const GeomPair& p) { return p.geom_a == pair.geom_a && p.geom_b == pair.geom_b; });
    if (same != pairs_.end()) {
      if (pair.surface_pair.depth_m > same->surface_pair.depth_m) same->surface_pair = pair.surface_pair;
      continue;
    }
    pair.body_a = body_of(pair.geom_a);
    pair.body_b = body_of(pair.geom_b);
    if (pair.body_a != pair.body_b) pairs_.push_back(pair);
  }
  std::ranges::sort(pairs_, [](const GeomPair& a, const GeomPair& b) {
    return a.geom_a != b.geom_a ? a.geom_a < b.geom_a : a.geom_b < b.geom_b;
  });
  return pairs_;
}

const HuntCrossley& CollisionModel::law(const GeomPair& pair) const {
  const auto a = static_cast<std::size_t>(pair.geom_a), b = static_cast<std::size_t>(pair.geom_b);
  return laws_[stiffness_[b] < stiffness_[a] ? b : a];
}

CollisionModel::Site CollisionModel::site(const std::string& name) const {
  const mjModel& m = *engine_->model;
  const int s = engine_->mujoco.number_of(&m, mjOBJ_SITE, name.c_str());
  if (s < 0) refuse(file_, "has no site \"" + name + "\"");
  const int joint = m.body_jntadr[m.site_bodyid[s]];
  const auto found =
      joint < 0 ? engine_->place.end() : std::ranges::find(engine_->place, m.jnt_qposadr[joint]);
  const int body = static_cast<int>(found - engine_->place.begin());
  if (body >= tool()) refuse(file_, "the site \"" + name + "\" is not part of a free body");
  return {body,
          engine_->X_IB[static_cast<std::size_t>(body)] * pose(m.site_pos + 3 * s, m.site_quat + 4 * s)};
}

int CollisionModel::geom(const std::string& name) const {
  const int g = engine_->mujoco.number_of(engine_->model, mjOBJ_GEOM, name.c_str());
  if (g < 0) refuse(file_, "has no geom \"" + name + "\"");
  return g;
}

Pose CollisionModel::geom_pose(int geom) const {
  const mjtNum* R = engine_->state->geom_xmat + 9 * geom;
  Matrix3 m;
  m << R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8];
  return {vector(engine_->state->geom_xpos + 3 * geom), Quaternion(m)};
}

bool CollisionModel::loaded() {
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_NOLOAD);
  if (library == nullptr) return false;
  dlclose(library);
  return true;
}

}  // namespace longreach
