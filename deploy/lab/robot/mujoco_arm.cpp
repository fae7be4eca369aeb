#include "deploy/lab/robot/mujoco_arm.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/lab/name_hash.hpp"
#include "deploy/mujoco/description.hpp"

namespace longreach {
namespace {

constexpr Duration kWatchdog = std::chrono::milliseconds(20);  // as in SimulatedArm
constexpr double kMean_s = 0.1;     // over which the penetration per force is averaged
constexpr double kFollowed = 0.01;  // change of a stiffness, relative

std::span<const double> numbers(const JointVector& q) {
  return {q.data(), static_cast<std::size_t>(q.size())};
}

JointVector vector_of(const std::vector<double>& numbers) {
  JointVector q;
  for (int i = 0; i < q.size(); ++i) q[i] = numbers[static_cast<std::size_t>(i)];
  return q;
}

/// `material` stands for a linear spring; its damping is not used.
double spring_of(const SceneConfig& scene, const SurfaceConfig& surface) {
  const auto material = std::ranges::find(scene.material, surface.material, &MaterialConfig::name);
  if (material == scene.material.end()) throw UnsuitableScene(surface.name + ": has no material");
  if (material->exponent != 1.0)
    throw UnsuitableScene(surface.name + ": its material is not a linear spring");
  return material->stiffness_n_per_m;
}

/// The blocks that replace the surfaces of a scene. The tool starts at `start_m`.
std::vector<MujocoSurface> surfaces_of(const SceneConfig& scene, const Vector3& start_m) {
  constexpr double kLarge_m = 1.0, kThick_m = 0.05;  // half of the edges of a plate that stands for a plane
  std::vector<MujocoSurface> out;
  for (const SurfaceConfig& surface : scene.surface) {
    if (surface.movement) throw UnsuitableScene(surface.name + ": it moves");
    if (!surface.body.empty()) throw UnsuitableScene(surface.name + ": it is a part of a body");
    MujocoSurface s{.name = surface.name, .stiffness_n_per_m = spring_of(scene, surface)};
    if (surface.plane) {
      const Vector3 out_of_it = surface.plane->normal.normalized();
      s.only_x = true;
      s.half_m = {kThick_m, kLarge_m, kLarge_m};
      s.X_WS.q = Quaternion::FromTwoVectors(Vector3::UnitX(), out_of_it);
      s.X_WS.p = surface.plane->point_m - kThick_m * out_of_it;
      if (surface.plane->from_tool_start) s.X_WS.p += start_m;
    } else if (surface.box) {
      s.half_m = 0.5 * surface.box->size_m;
      s.X_WS = {surface.box->centre_m, exp_rotation(surface.box->rotation_rad)};
      if (surface.box->from_tool_start) s.X_WS.p += start_m;
    } else {
      throw UnsuitableScene(surface.name + ": is neither a plane nor a box");
    }
    out.push_back(s);
  }
  return out;
}

/// What the actuators of the file do not move follows with the bandwidth of the configuration.
MujocoOptions options_of(const SlaveConfig& config, const Vector3& start_m, const MujocoBodies* bodies) {
  const MujocoWorld world(config.robot.mjcf, {});
  return {.servo_hz = world.servo_hz() > 0.0 ? config.robot.servo_hz : 0.0,
          .force_noise_n = 0.0,
          .moment_noise_nm = 0.0,
          .surfaces = surfaces_of(config.scene, start_m),
          .bodies = bodies};
}

proto::Robot describe_mjcf(const std::string& file) {
  try {
    return describe(MujocoWorld(file, {}), file);
  } catch (const std::invalid_argument& problem) {
    throw ConfigError(problem.what());
  }
}

void check_mjcf(proto::SlaveConfig& config, bool servo_set) {
  const std::string& file = config.robot().mjcf();
  const double tick_s = 1.0 / config.loop().rate_hz();
  try {
    const MujocoWorld world(file, {});
    require_same(config.robot(), "robot", world, file);
    const double steps = tick_s / world.time_step_s();
    if (std::abs(steps - std::round(steps)) > 1e-6 || steps < 0.5)
      throw ConfigError(file + ": the time step of " + std::to_string(world.time_step_s()) +
                        " s does not divide the period of " + std::to_string(tick_s) + " s (loop.rate_hz)");
    if (world.servo_hz() > 0.0 && !(config.robot().servo_hz() > 0.0))
      throw ConfigError(file +
                        ": has no position actuator for each joint, so robot.servo_hz must be above 0");
    if (world.servo_hz() == 0.0 && servo_set)
      throw ConfigError("robot.servo_hz has no effect, because the position actuators of " + file +
                        " move the joints");
    for (int i = 0; i < config.robot().joint_size(); ++i) {
      const proto::Joint& joint = config.robot().joint(i);
      const MujocoJoint& of_file = world.joints()[static_cast<std::size_t>(i)];
      if (joint.min_rad() < of_file.min || joint.max_rad() > of_file.max)
        throw ConfigError(file + ": the joint " + of_file.name + " has the range " +
                          std::to_string(of_file.min) + " to " + std::to_string(of_file.max) +
                          ", but robot.joint." + std::to_string(i) + " permits " +
                          std::to_string(joint.min_rad()) + " to " + std::to_string(joint.max_rad()));
    }
    config.mutable_robot()->set_basis(config.robot().basis() + ", model " +
                                      name_hash(std::to_string(world.fingerprint())));
  } catch (const std::invalid_argument& problem) {
    throw ConfigError(problem.what());
  }
}

std::unique_ptr<SimulatedRobot> make_mujoco_arm(const SlaveConfig& config, Random random) {
  return std::make_unique<MujocoArm>(config, random);
}

constexpr MjcfRobots kMujoco{describe_mjcf, check_mjcf, make_mujoco_arm};

}  // namespace

void use_mujoco() { mjcf_robots = &kMujoco; }

MujocoArm::MujocoArm(const SlaveConfig& config, Random random)
    : sensing_(config.sensing),
      kinematics_(config.robot),
      joint_rad_(start_joints(config.robot)),
      X_WE_start_(kinematics_.forward(joint_rad_)),
      X_WE_(X_WE_start_),
      added_(config.scene.bodies ? std::optional<MujocoBodies>(std::in_place, config.scene, X_WE_start_)
                                 : std::nullopt),
      world_(config.robot.mjcf, options_of(config, X_WE_start_.p, added_ ? &*added_ : nullptr)),
      sensor_(config.sensing, random) {
  require_same(to_message(config).robot(), "robot", world_, config.robot.mjcf);
  world_.place(numbers(joint_rad_));
  if (config.scene.bodies) bodies_.emplace(world_, config.scene, X_WE_start_);
  // The tool may start inside a surface.
  constexpr double kSettle_s = 0.5;
  if (!config.scene.surface.empty()) world_.settle(kSettle_s);
}

RobotState MujocoArm::read(Time now) {
  const double dt = now_ ? std::max(0.0, to_seconds(now - *now_)) : 0.0;
  now_ = now;
  if (written_ && now - *written_ > kWatchdog && !stopped_) {
    stopped_ = true;
    follows_ = false;
    world_.stop();
  }
  if (bodies_) {
    bodies_->step(dt);
  } else {
    world_.step(dt);
  }
  feel(dt);
  RobotState state;
  state.joint_rad = joint_rad_;
  state.joint_rad_per_s = joint_rad_per_s_;
  state.load = bodies_ && bodies_->contact().holds;
  if (sensing_.force) {
    const Wrench reported = sensor_.step(world_.wrench(), dt);
    state.F_F_W = {X_WE_.q * reported.moment, X_WE_.q * reported.force};
  }
  return state;
}

void MujocoArm::write(const std::optional<JointVector>& joint_setpoint_rad) {
  if (joint_setpoint_rad && !joint_setpoint_rad->allFinite()) {
    ++rejected_;
    return;
  }
  if (joint_setpoint_rad) world_.follow(numbers(*joint_setpoint_rad));
  if (!joint_setpoint_rad && follows_) world_.stop();
  follows_ = joint_setpoint_rad.has_value();
  written_ = now_;
  stopped_ = false;
}

void MujocoArm::displace(const JointVector& joint_rad) {
  world_.place(numbers(joint_rad));
  follows_ = false;
}

void MujocoArm::feel(double dt) {
  joint_rad_ = vector_of(world_.positions());
  joint_rad_per_s_ = vector_of(world_.speeds());
  const ToolKinematics tool = kinematics_.forward_with_jacobian(joint_rad_);
  X_WE_ = tool.X_WE;
  V_WE_ = {tool.J.topRows<3>() * joint_rad_per_s_, tool.J.bottomRows<3>() * joint_rad_per_s_};
  F_E_W_ = {};
  depth_m_ = 0.0;
  for (Known& known : known_) known.seen.force_n = 0.0;
  for (const MujocoContact& contact : world_.contacts()) {
    F_E_W_.moment += contact.F_E_W.moment;
    F_E_W_.force += contact.F_E_W.force;
    depth_m_ = std::max(depth_m_, contact.depth_m);
    auto known = std::ranges::find(known_, contact.geom, &Known::geom);
    if (known == known_.end())
      known = known_.insert(known_.end(),
                            Known{.geom = contact.geom, .seen = {.name = world_.geom_name(contact.geom)}});
    TouchedGeom& seen = known->seen;
    seen.force_n = contact.F_E_W.force.norm();
    seen.force_max_n = std::max(seen.force_max_n, seen.force_n);
    seen.depth_max_m = std::max(seen.depth_max_m, contact.depth_m);
    known->tool_m = X_WE_.p;
    const double kept = std::exp(-dt / kMean_s);
    known->depth_sum_m = kept * known->depth_sum_m + std::max(0.0, contact.depth_m);
    known->force_sum_n = kept * known->force_sum_n + contact.normal_n;
    const double compliance = world_.spring_compliance(contact) + known->depth_sum_m / known->force_sum_n;
    const double stiffness = compliance > 0.0 ? 1.0 / compliance : 0.0;
    if (std::abs(stiffness - known->stiffness_n_per_m) > kFollowed * stiffness)
      known->stiffness_n_per_m = stiffness;
  }
  if (bodies_) F_E_W_ = bodies_->contact().F_E_W;  // also what it holds
}

BodyPoses MujocoArm::tracked_bodies() const {
  BodyPoses poses;
  for (int i = 0; bodies_ && i < bodies_->count(); ++i)
    poses.body[static_cast<std::size_t>(i)] = BodyPose{.X_WB = bodies_->pose(i)};
  return poses;
}

double MujocoArm::material_stiffness(const Vector3& p_WE) const {
  const Known* nearest = nullptr;
  for (const Known& known : known_)
    if (nearest == nullptr || (known.tool_m - p_WE).norm() < (nearest->tool_m - p_WE).norm())
      nearest = &known;
  return nearest == nullptr ? 0.0 : nearest->stiffness_n_per_m;
}

std::vector<TouchedGeom> MujocoArm::touched() const {
  std::vector<TouchedGeom> out;
  for (const Known& known : known_) out.push_back(known.seen);
  return out;
}

void MujocoArm::surround(const SceneConfig&) {
  throw std::invalid_argument("robot.mjcf is set, so the surroundings are those of the MJCF file");
}

}  // namespace longreach
