#include "slave/simulation/simulated_arm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slave/simulation/flexible_joint.hpp"
#include "slave/simulation/scene/yielding.hpp"

namespace longreach {
namespace {

constexpr Duration kWatchdog = std::chrono::milliseconds(20);
constexpr int kCorrections = 6;     // of a touching tool's way in a tick
constexpr double kBesideM = 1e-13;  // that is not corrected

struct Servo {
  double rate_per_s;  // ω; 0: ideal
  double speed_max_rad_per_s;
};

struct JointMotion {
  double angle_rad;
  double rad_per_s;
};

// One joint over dt: at the speed limit while the servo asks for more, then the exponential approach.
JointMotion approach(const Servo& servo, double angle_rad, double setpoint_rad, double dt) {
  const double error = setpoint_rad - angle_rad;
  const double sign = error < 0.0 ? -1.0 : 1.0;
  const double distance = std::abs(error);
  const double speed_max = servo.speed_max_rad_per_s;
  if (!(servo.rate_per_s > 0.0)) {
    const double travel = std::min(distance, speed_max * dt);
    return {angle_rad + sign * travel, dt > 0.0 ? sign * travel / dt : 0.0};
  }
  const double corner = speed_max / servo.rate_per_s;
  const double saturated = std::min(dt, std::max(0.0, (distance - corner) / speed_max));
  const double rest = (distance - speed_max * saturated) * std::exp(-servo.rate_per_s * (dt - saturated));
  return {setpoint_rad - sign * rest, sign * std::min(speed_max, servo.rate_per_s * rest)};
}

// One joint over dt without a setpoint: at its acceleration limit to rest.
JointMotion brake(double limit_rad_per_s2, double angle_rad, double rad_per_s, double dt) {
  const double sign = rad_per_s < 0.0 ? -1.0 : 1.0;
  const double braking_s = std::min(dt, std::abs(rad_per_s) / limit_rad_per_s2);
  const double left = std::abs(rad_per_s) - limit_rad_per_s2 * braking_s;
  const double way = 0.5 * (std::abs(rad_per_s) + left) * braking_s;
  return {angle_rad + sign * way, braking_s < dt ? 0.0 : sign * left};
}

bool flexible(const JointConfig& joint) { return joint.stiffness_nm_per_rad > 0.0; }

ToolMotion tool_motion(const Pose& X_WE, double t_s) { return {.p_WE = X_WE.p, .q_WE = X_WE.q, .t_s = t_s}; }

}  // namespace

SimulatedArm::SimulatedArm(const SlaveConfig& config, Random random)
    : robot_(config.robot),
      sensing_(config.sensing),
      kinematics_(config.robot),
      X_WE_start_(kinematics_.forward(start_joints(config.robot))),
      scene_(config.scene, X_WE_start_),
      bodies_(config.scene.bodies ? std::optional<Bodies>(std::in_place, config.scene, X_WE_start_)
                                  : std::nullopt),
      sensor_(config.sensing, random),
      joint_rad_(start_joints(config.robot)),
      servo_rad_(joint_rad_),
      flexible_(std::ranges::any_of(config.robot.joint, flexible)),
      X_WE_(X_WE_start_) {}

RobotState SimulatedArm::read(Time now) {
  const double dt = now_ ? std::max(0.0, to_seconds(now - *now_)) : 0.0;
  now_ = now;
  if (written_ && now - *written_ > kWatchdog && !stopped_) {
    stopped_ = true;
    setpoint_rad_.reset();
  }
  t_s_ += dt;
  move(dt);
  feel(dt);
  RobotState state;
  state.joint_rad = joint_rad_;
  state.joint_rad_per_s = joint_rad_per_s_;
  if (sensing_.force) state.F_F_W = sense(dt);
  state.load = bodies_ && bodies_->contact().holds;
  return state;
}

BodyPoses SimulatedArm::tracked_bodies() const {
  static_assert(CollisionModel::kBodiesMax <= static_cast<int>(kTrackedBodies));
  BodyPoses poses;
  for (int i = 0; bodies_ && i < bodies_->count(); ++i)
    poses.body[static_cast<std::size_t>(i)] = BodyPose{.X_WB = bodies_->pose(i)};
  return poses;
}

void SimulatedArm::write(const std::optional<JointVector>& joint_setpoint_rad) {
  if (joint_setpoint_rad && !joint_setpoint_rad->allFinite()) {
    ++rejected_;
    return;
  }
  setpoint_rad_ = joint_setpoint_rad;
  written_ = now_;
  stopped_ = false;
}

void SimulatedArm::displace(const JointVector& joint_rad) {
  joint_rad_ = servo_rad_ = joint_rad;
  joint_rad_per_s_.setZero();
  servo_rad_per_s_.setZero();
  setpoint_rad_.reset();
}

void SimulatedArm::move(double dt) {
  const double rate = 2.0 * std::numbers::pi * robot_.servo_hz;
  std::array<ServoMotion, kMaxJoints> servo;
  std::array<LinkState, kMaxJoints> link;
  for (int i = 0; i < kMaxJoints; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double before_rad = servo_rad_[i];
    const JointConfig& joint = robot_.joint[k];
    const JointMotion motion =
        setpoint_rad_ ? approach({rate, joint.speed_max_rad_per_s}, before_rad, (*setpoint_rad_)[i], dt)
                      : brake(joint.acceleration_max_rad_per_s2, before_rad, servo_rad_per_s_[i], dt);
    servo_rad_[i] = motion.angle_rad;
    servo_rad_per_s_[i] = motion.rad_per_s;
    servo[k] = {before_rad, dt > 0.0 ? (motion.angle_rad - before_rad) / dt : 0.0};
    link[k] = {joint_rad_[i], joint_rad_per_s_[i]};
    joint_rad_[i] = motion.angle_rad;
    joint_rad_per_s_[i] = motion.rad_per_s;
  }
  if (!flexible_ || !(dt > 0.0)) return;
  const auto swing_all = [&](const JointVector& torque_nm) {
    for (int i = 0; i < kMaxJoints; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      if (!flexible(robot_.joint[k])) continue;
      const LinkState next = swing(robot_.joint[k], link[k], servo[k], torque_nm[i], dt);
      joint_rad_[i] = next.rad;
      joint_rad_per_s_[i] = next.rad_per_s;
    }
  };
  swing_all(JointVector::Zero());
  if (scene_.empty()) return;
  JointVector before_rad, give = JointVector::Zero();  // rad, rad/(N m)
  for (int i = 0; i < kMaxJoints; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    JointConfig smooth = robot_.joint[k];
    smooth.friction_nm = 0.0;
    before_rad[i] = flexible(smooth) ? link[k].rad : servo[k].rad;
    if (flexible(smooth)) give[i] = swing(smooth, {}, {}, 1.0, dt).rad;
  }
  const ToolMotion from = tool_motion(X_WE_, t_s_ - dt);
  ToolMotion free = tool_motion(kinematics_.forward(joint_rad_), t_s_);
  for (int i = 0; i < kCorrections; ++i) {
    const Jacobian J = kinematics_.rigid_with_jacobian(0.5 * (before_rad + joint_rad_)).J;
    const Yielded tool = yield(scene_, from, free, J * give.asDiagonal() * J.transpose(), dt);
    if (i == 0 && tool.wrench.isZero(0.0)) return;
    swing_all(J.transpose() * tool.wrench);
    // The tool's way is not the straight line that the compliance makes of it.
    const Pose X_WE = kinematics_.forward(joint_rad_);
    const Vector3 beside_m = X_WE.p - tool.to.p_WE;
    free.p_WE += beside_m;
    free.q_WE = (X_WE.q * tool.to.q_WE.conjugate() * free.q_WE).normalized();
    if (beside_m.norm() <= kBesideM) return;
  }
}

void SimulatedArm::feel(double dt) {
  const ToolKinematics tool = kinematics_.forward_with_jacobian(joint_rad_);
  X_WE_ = tool.X_WE;
  V_WE_ = {tool.J.topRows<3>() * joint_rad_per_s_, tool.J.bottomRows<3>() * joint_rad_per_s_};
  contact_ = scene_.contact({X_WE_.p, V_WE_.linear, X_WE_.q, V_WE_.angular, t_s_});
  F_E_W_ = {contact_.moment_nm, contact_.force_n};
  if (!bodies_) return;
  const BodiesContact& met = bodies_->step(X_WE_, dt);
  F_E_W_.moment += met.F_E_W.moment;
  F_E_W_.force += met.F_E_W.force;
  contact_.depth_m = std::max(contact_.depth_m, met.depth_m);
}

// The sensor's channels are along the axes of the tool, and it carries the tool.
Wrench SimulatedArm::sense(double dt) {
  const SensorMotion motion = motion_.step(X_WE_.q, V_WE_, sensing_.gravity_m_per_s2, 0.0, dt);
  const Wrench tool = tool_wrench(sensing_.tool, motion);
  const Quaternion q_EW = X_WE_.q.conjugate();
  const Wrench reported =
      sensor_.step({q_EW * F_E_W_.moment + tool.moment, q_EW * F_E_W_.force + tool.force}, dt);
  return {X_WE_.q * reported.moment, X_WE_.q * reported.force};
}

double SimulatedArm::material_stiffness(const Vector3& p_WE) const {
  const auto at = [this](const Vector3& p) {
    return scene_.contact({.p_WE = p, .q_WE = X_WE_start_.q, .t_s = t_s_});
  };
  const SceneContact here = at(p_WE);
  const Vector3 step = 1e-4 * here.depth_m * here.normal;
  if (step.isZero(0.0)) return 0.0;
  return here.normal.dot(at(p_WE - step).force_n - at(p_WE + step).force_n) / (2.0 * step.norm());
}

}  // namespace longreach
