#include "deploy/mujoco/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "deploy/mujoco/mjcf_text.hpp"
#include "deploy/mujoco/numbers.hpp"
#include "deploy/mujoco/urdf_arm.hpp"

namespace longreach {
namespace {

// MuJoCo says "XML Error: ... Element 'geom', line 12, column 5": the line belongs to the file, if
// MuJoCo read it unchanged.
std::string with_line(const std::string& file, std::string error, bool unchanged) {
  std::ranges::replace(error, '\n', ' ');
  while (!error.empty() && error.back() == ' ') error.pop_back();
  if (error.find("mass and inertia of moving bodies") != std::string::npos)
    error += "; a body or link that a joint moves needs a mass (<inertial>)";
  if (error.find("unrecognized name of sensorized object") != std::string::npos)
    error += "; a sensor names a site or another object that the file does not have";
  const std::size_t at = error.find("line ");
  const std::size_t end = at == std::string::npos ? at : error.find_first_not_of("0123456789", at + 5);
  if (!unchanged || at == std::string::npos || end == at + 5)
    return file + ": " + error + " (MuJoCo " + mj_versionString() + ")";
  return file + ":" + error.substr(at + 5, end - at - 5) + ": " + error + " (MuJoCo " + mj_versionString() +
         ")";
}

void be_silent(const char*) {}

using Model = std::unique_ptr<mjModel, void (*)(mjModel*)>;

/// A text that MuJoCo reads instead of the file of this name.
class Replaced {
 public:
  Replaced(const std::string& file, const std::string& text) : files_(new mjVFS) {
    mj_defaultVFS(files_.get());
    const std::string name = std::filesystem::path(file).filename();
    if (mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(text.size())) != 0)
      throw std::invalid_argument(file + ": MuJoCo cannot store the text of the file");
    text.copy(static_cast<char*>(files_->filedata[0]), text.size());
  }
  ~Replaced() { mj_deleteVFS(files_.get()); }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;
  [[nodiscard]] const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;  // 2 MB
};

/// `mjcf`, if it is not null, becomes the text that MuJoCo writes for the file.
Model load(const std::string& file, const mjVFS* replaced = nullptr, std::string* mjcf = nullptr) {
  if (!std::filesystem::is_regular_file(file)) throw std::invalid_argument(file + ": there is no such file");
  static std::mutex one_at_a_time;  // MuJoCo keeps the last file
  const std::scoped_lock lock(one_at_a_time);
  mju_user_warning = be_silent;  // it would write a file into the working folder
  std::array<char, 1000> error{};
  mjModel* model = mj_loadXML(file.c_str(), replaced, error.data(), static_cast<int>(error.size()));
  if (!model) throw std::invalid_argument(with_line(file, error.data(), replaced == nullptr));
  Model loaded(model, mj_deleteModel);
  if (mjcf != nullptr) *mjcf = last_mjcf(file, *model);
  return loaded;
}

std::string name_of(const mjModel* m, mjtObj kind, int number) {
  const char* name = mj_id2name(m, kind, number);
  return name ? name : "number " + std::to_string(number);
}

std::string names_of(const mjModel* m, mjtObj kind, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += (i > 0 ? ", " : "") + name_of(m, kind, i);
  return all.empty() ? "none" : all;
}

/// Whether the geom belongs to the body of the site or to a body on it.
bool carries(const mjModel* m, int site, int geom) {
  int body = m->geom_bodyid[geom];
  while (body > 0 && body != m->site_bodyid[site]) body = m->body_parentid[body];
  return body > 0;
}

/// The friction that the file states for what is put in front of the tool.
std::optional<double> said_friction(const mjModel* m, const std::string& file) {
  const int said = mj_name2id(m, mjOBJ_NUMERIC, "surface_friction");
  if (said < 0) return {};
  const double sliding = m->numeric_data[m->numeric_adr[said]];
  if (!(sliding >= 0.0))
    throw std::invalid_argument(file + ": the numeric \"surface_friction\" must be at least 0");
  return sliding;
}

MujocoTip tip_of(const mjModel* m, const std::string& file, int site) {
  int tip = -1, tips = 0;
  for (int i = 0; i < m->ngeom; ++i) {
    if (site < 0 || !carries(m, site, i) || (m->geom_contype[i] == 0 && m->geom_conaffinity[i] == 0))
      continue;
    tip = i;
    ++tips;
  }
  const Vector3 off =
      tips == 1 ? Vector3(vector_at(m->geom_pos + 3 * tip) - vector_at(m->site_pos + 3 * site)) : Vector3();
  constexpr double kOff_m = 1e-6;
  if (tips != 1 || m->geom_type[tip] != mjGEOM_SPHERE || m->geom_bodyid[tip] != m->site_bodyid[site] ||
      off.norm() > kOff_m)
    throw std::invalid_argument(
        file +
        ": only one geom of the tool may collide, a sphere around its site, so that surfaces "
        "can be put in front of it");
  Vector3 friction = vector_at(m->geom_friction + 3 * tip);
  friction.x() = said_friction(m, file).value_or(friction.x());
  return {m->geom_size[static_cast<std::ptrdiff_t>(3) * tip], m->geom_contype[tip], m->geom_conaffinity[tip],
          friction};
}

/// Sets options.tool_link, and appends to `notes`.
Model load_urdf(const std::string& file, MujocoOptions& options, std::vector<std::string>& notes) {
  if (!options.surfaces.empty() || options.bodies != nullptr)
    throw std::invalid_argument(file +
                                ": surfaces and bodies can be put only in front of a robot of an MJCF file");
  const UrdfArm arm = urdf_arm(file, options.tool_link);
  options.tool_link = arm.robot.tip_link();
  notes = arm.notes;
  std::string mjcf;
  const Replaced urdf(file, arm.text);
  const Model exact = load(file, urdf.get(), &mjcf);
  const Replaced replaced(file, with_sensors(mjcf, *exact, arm, options.site, notes));
  return load(file, replaced.get());
}

Model load_world(const std::string& file, MujocoOptions& options, std::vector<std::string>& notes) {
  if (holds_urdf(file)) return load_urdf(file, options, notes);
  if (!options.tool_link.empty())
    throw std::invalid_argument(file + ": is no URDF, so its tool is a site (--site) and not a link");
  Model plain = load(file);
  if (options.surfaces.empty() && options.bodies == nullptr) return plain;
  const mjModel* m = plain.get();
  const int site = mj_name2id(m, mjOBJ_SITE, options.site.c_str());
  tinyxml2::XMLDocument document;
  read_mjcf(file, document);
  if (!options.surfaces.empty())
    add_surfaces(*document.RootElement(), options.surfaces, tip_of(m, file, site), m->opt.timestep);
  if (options.bodies != nullptr && site >= 0) {
    options.bodies->add(*document.RootElement(), options.site,
                        pose_at(m->site_pos + 3 * site, m->site_quat + 4 * site),
                        said_friction(m, file).value_or(0.0));
  }
  const Replaced replaced(file, text_of(document));
  Model model = load(file, replaced.get());
  if (options.bodies == nullptr) return model;
  options.bodies->set_laws(*model);
  // The gripper of the scene is the tool.
  const int tool = mj_name2id(model.get(), mjOBJ_SITE, options.site.c_str());
  for (int i = 0; i < model->ngeom; ++i)
    if (carries(model.get(), tool, i)) model->geom_contype[i] = model->geom_conaffinity[i] = 0;
  return model;
}

}  // namespace

MujocoWorld::MujocoWorld(const std::string& file, const MujocoOptions& options)
    : file_(file),
      options_(options),
      model_(load_world(file, options_, notes_)),
      data_(mj_makeData(model_.get()), mj_deleteData),
      random_(options.seed) {
  const mjModel* m = model_.get();
  name_ = m->names;
  site_ = mj_name2id(m, mjOBJ_SITE, options.site.c_str());
  if (site_ < 0)
    throw std::invalid_argument(
        file_ + ": has no site \"" + options.site +
        "\", which is the tool frame; its sites: " + names_of(m, mjOBJ_SITE, m->nsite));
  to_start();
  take_joints();
  take_sensors();
  take_actuators();
  mj_forward(m, data_.get());
  stop();
}

MujocoWorld::~MujocoWorld() = default;

bool MujocoWorld::of_tool(int geom) const { return carries(model_.get(), site_, geom); }

void MujocoWorld::take_joints() {
  const mjModel* m = model_.get();
  const int tool = m->site_bodyid[site_];
  if (m->body_jntnum[tool] > 0)
    throw std::invalid_argument(
        file_ + ": the body \"" + name_of(m, mjOBJ_BODY, tool) + "\" of the site \"" + options_.site +
        "\" has a joint, whose torque its sensors would measure; put the site into a body of its "
        "own without a joint");
  for (int body = tool; body > 0; body = m->body_parentid[body])
    for (int j = m->body_jntnum[body] - 1; j >= 0; --j)
      number_.insert(number_.begin(), m->body_jntadr[body] + j);
  for (const int j : number_) {
    const std::string name = name_of(m, mjOBJ_JOINT, j);
    if (m->jnt_type[j] != mjJNT_HINGE && m->jnt_type[j] != mjJNT_SLIDE)
      throw std::invalid_argument(file_ + ": the joint " + name +
                                  " between the world and the tool is neither a hinge nor a slide");
    joints_.push_back({.name = name, .start = data_->qpos[m->jnt_qposadr[j]]});
    if (m->jnt_limited[j] != 0) {
      joints_.back().min = m->jnt_range[2 * j];
      joints_.back().max = m->jnt_range[2 * j + 1];
    }
  }
  // The axes with all joints at zero.
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> zero(mj_copyData(nullptr, m, data_.get()),
                                                               mj_deleteData);
  for (const int j : number_) zero->qpos[m->jnt_qposadr[j]] = 0.0;
  mj_kinematics(m, zero.get());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    joints_[i].axis = {vector_at(zero->xanchor + 3 * number_[i]),
                       vector_at(zero->xaxis + 3 * number_[i]).normalized(),
                       m->jnt_type[number_[i]] == mjJNT_SLIDE};
}

void MujocoWorld::take_sensors() {
  const mjModel* m = model_.get();
  const auto place = [&](mjtSensor kind, const char* word) {
    for (int i = 0; i < m->nsensor; ++i)
      if (m->sensor_type[i] == kind && m->sensor_objid[i] == site_) return m->sensor_adr[i];
    throw std::invalid_argument(file_ + ": the site \"" + options_.site + "\" has no " + word +
                                " sensor; add <" + word + " site=\"" + options_.site + "\"/> to <sensor>");
  };
  force_at_ = place(mjSENS_FORCE, "force");
  torque_at_ = place(mjSENS_TORQUE, "torque");
}

void MujocoWorld::take_actuators() {
  const mjModel* m = model_.get();
  if (!options_.gripper.empty()) {
    gripper_ = mj_name2id(m, mjOBJ_ACTUATOR, options_.gripper.c_str());
    if (gripper_ < 0)
      throw std::invalid_argument(file_ + ": has no actuator \"" + options_.gripper +
                                  "\"; its actuators: " + names_of(m, mjOBJ_ACTUATOR, m->nu));
    if (m->actuator_ctrllimited[gripper_] == 0)
      throw std::invalid_argument(file_ + ": the actuator \"" + options_.gripper +
                                  "\" has no ctrlrange, whose ends open and close the gripper");
  }
  torque_.assign(static_cast<std::size_t>(m->nv), 0.0);
  wanted_ = torque_;
  constexpr double kUsual_hz = 10.0;
  if (options_.servo_hz > 0.0) return;
  for (const int j : number_) {
    for (int a = 0; a < m->nu; ++a)
      if (m->actuator_trntype[a] == mjTRN_JOINT && m->actuator_trnid[2 * a] == j &&
          m->actuator_biastype[a] == mjBIAS_AFFINE)
        actuator_.push_back(a);
  }
  if (actuator_.size() == number_.size()) return;
  actuator_.clear();
  options_.servo_hz = kUsual_hz;
}

Pose MujocoWorld::site_at(std::span<const double> joint) const {
  const mjModel* m = model_.get();
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_copyData(nullptr, m, data_.get()),
                                                               mj_deleteData);
  for (std::size_t i = 0; i < number_.size(); ++i) data->qpos[m->jnt_qposadr[number_[i]]] = joint[i];
  mj_kinematics(m, data.get());
  return pose_with_matrix(data->site_xpos + 3 * site_, data->site_xmat + 9 * site_);
}

void MujocoWorld::follow(std::span<const double> setpoint) {
  setpoint_.assign(setpoint.begin(), setpoint.end());
}

void MujocoWorld::stop() { setpoint_ = positions(); }

void MujocoWorld::to_start() {
  if (model_->nkey > 0) {
    mj_resetDataKeyframe(model_.get(), data_.get(), 0);
  } else {
    mj_resetData(model_.get(), data_.get());
  }
}

void MujocoWorld::reset() {
  to_start();
  mj_forward(model_.get(), data_.get());
  stop();
}

void MujocoWorld::place(std::span<const double> joint) {
  for (std::size_t i = 0; i < number_.size(); ++i) {
    data_->qpos[model_->jnt_qposadr[number_[i]]] = joint[i];
    data_->qvel[model_->jnt_dofadr[number_[i]]] = 0.0;
  }
  mj_forward(model_.get(), data_.get());
  stop();
}

void MujocoWorld::settle(double seconds) {
  const std::vector<double> joint = positions();
  for (double t = 0.0; t < seconds; t += time_step_s()) {
    mj_step(model_.get(), data_.get());
    check_numbers();
    place(joint);
  }
}

void MujocoWorld::grip(bool closed) {
  if (gripper_ >= 0) data_->ctrl[gripper_] = model_->actuator_ctrlrange[2 * gripper_ + (closed ? 1 : 0)];
}

double MujocoWorld::time_step_s() const { return model_->opt.timestep; }

void MujocoWorld::compute_torque() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  const double w = 2.0 * std::numbers::pi * options_.servo_hz;
  std::ranges::fill(wanted_, 0.0);
  for (std::size_t i = 0; i < number_.size(); ++i) {
    const int dof = m->jnt_dofadr[number_[i]];
    const double off = setpoint_[i] - d->qpos[m->jnt_qposadr[number_[i]]];
    wanted_[static_cast<std::size_t>(dof)] = w * w * off - 2.0 * w * d->qvel[dof];
  }
  mj_mulM(m, d, torque_.data(), wanted_.data());
  for (const int j : number_) {
    const int dof = m->jnt_dofadr[j];
    d->qfrc_applied[dof] = torque_[static_cast<std::size_t>(dof)] + d->qfrc_bias[dof] - d->qfrc_passive[dof];
  }
}

void MujocoWorld::step(double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / model_->opt.timestep));
  if (steps > 0) sensed_ = {};
  for (int n = 0; n < steps; ++n) {
    mj_step1(model_.get(), data_.get());
    if (options_.servo_hz > 0.0) compute_torque();
    for (std::size_t i = 0; i < actuator_.size(); ++i) data_->ctrl[actuator_[i]] = setpoint_[i];
    mj_step2(model_.get(), data_.get());
    check_numbers();
    // MuJoCo gives what the parent exerts on the body.
    sensed_.moment -= vector_at(data_->sensordata + torque_at_) / steps;
    sensed_.force -= vector_at(data_->sensordata + force_at_) / steps;
  }
}

void MujocoWorld::check_numbers() const {
  for (const int kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL}) {
    if (data_->warning[kind].number == 0) continue;
    throw std::runtime_error(
        file_ + ": the simulation diverges after " + std::to_string(data_->time) +
        " s: " + mju_warningText(kind, static_cast<std::size_t>(data_->warning[kind].lastinfo)));
  }
}

std::vector<double> MujocoWorld::positions() const {
  std::vector<double> q;
  for (const int j : number_) q.push_back(data_->qpos[model_->jnt_qposadr[j]]);
  return q;
}

std::vector<double> MujocoWorld::speeds() const {
  std::vector<double> v;
  for (const int j : number_) v.push_back(data_->qvel[model_->jnt_dofadr[j]]);
  return v;
}

Wrench MujocoWorld::measured() {
  Wrench out = sensed_;
  out.force += options_.bias.force;
  out.moment += options_.bias.moment;
  for (int i = 0; i < 3; ++i) out.force[i] += options_.force_noise_n * random_.normal();
  for (int i = 0; i < 3; ++i) out.moment[i] += options_.moment_noise_nm * random_.normal();
  return out;
}

}  // namespace longreach
