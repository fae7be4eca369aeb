#include "slave/robot/simulated_arm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slave/robot/flexible_joint.hpp"

namespace longreach {
namespace {

constexpr Duration kWatchdog = std::chrono::milliseconds(20);

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

JointVector start_joints(const RobotConfig& robot) {
  JointVector q;
  for (int i = 0; i < kMaxJoints; ++i) q[i] = robot.joint[static_cast<std::size_t>(i)].start_rad;
  return q;
}

}  // namespace

SimulatedArm::SimulatedArm(const SlaveConfig& config, Random random)
    : robot_(config.robot),
      sensing_(config.sensing),
      kinematics_(config.robot),
      X_WE_start_(kinematics_.forward(start_joints(config.robot))),
      scene_(config.scene, X_WE_start_),
      random_(random),
      joint_rad_(start_joints(config.robot)),
      servo_rad_(joint_rad_),
      setpoint_rad_(joint_rad_),
      X_WE_(X_WE_start_) {}

RobotState SimulatedArm::read(Time now) {
  const double dt = now_ ? std::max(0.0, to_seconds(now - *now_)) : 0.0;
  now_ = now;
  if (written_ && now - *written_ > kWatchdog && !stopped_) {
    stopped_ = true;
    setpoint_rad_ = servo_rad_;
  }
  t_s_ += dt;
  move(dt);
  feel();
  RobotState state;
  state.joint_rad = joint_rad_;
  state.joint_rad_per_s = joint_rad_per_s_;
  state.F_F_W = F_E_W_;
  if (!scene_.empty()) {
    for (int i = 0; i < 3; ++i) state.F_F_W.force[i] += sensing_.force_noise_n * random_.normal();
    for (int i = 0; i < 3; ++i) state.F_F_W.moment[i] += sensing_.moment_noise_nm * random_.normal();
  }
  return state;
}

void SimulatedArm::write(const JointVector& joint_setpoint_rad) {
  if (!joint_setpoint_rad.allFinite()) {
    ++rejected_;
    return;
  }
  setpoint_rad_ = joint_setpoint_rad;
  written_ = now_;
  stopped_ = false;
}

void SimulatedArm::move(double dt) {
  const double rate = 2.0 * std::numbers::pi * robot_.servo_hz;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& joint = robot_.joint[static_cast<std::size_t>(i)];
    const double before_rad = servo_rad_[i];
    const JointMotion motion = approach({rate, joint.speed_max_rad_per_s}, before_rad, setpoint_rad_[i], dt);
    servo_rad_[i] = motion.angle_rad;
    LinkState link{motion.angle_rad, motion.rad_per_s};
    if (joint.stiffness_nm_per_rad > 0.0) {
      const double even = dt > 0.0 ? (motion.angle_rad - before_rad) / dt : 0.0;
      link = swing(joint, {joint_rad_[i], joint_rad_per_s_[i]}, {before_rad, even}, torque_nm_[i], dt);
    }
    joint_rad_[i] = link.rad;
    joint_rad_per_s_[i] = link.rad_per_s;
  }
}

void SimulatedArm::feel() {
  const ToolKinematics tool = kinematics_.forward_with_jacobian(joint_rad_);
  X_WE_ = tool.X_WE;
  v_WE_ = tool.J.bottomRows<3>() * joint_rad_per_s_;
  const Vector3 w_WE = tool.J.topRows<3>() * joint_rad_per_s_;
  contact_ = scene_.contact({X_WE_.p, v_WE_, X_WE_.q, w_WE, t_s_});
  if (contact_.surface >= 0) surface_ = contact_.surface;
  F_E_W_ = {contact_.moment_nm, contact_.force_n};
  torque_nm_ = tool.J.transpose() * (Vector6() << F_E_W_.moment, F_E_W_.force).finished();
}

double SimulatedArm::material_secant(double depth_m) const {
  return scene_.secant_n_per_m(surface_, depth_m);
}

}  // namespace longreach
