#pragma once
// A simulated robot with six joints and first-order servos. Forward kinematics gives the pose of the tool.
// The scene exerts a force on the tool, which is mounted on a force sensor at E.
//   q̇ = ω (q_set - q), |q̇| <= joint speed limit, ω = 2π servo_hz, integrated exactly over each tick
//                                                                   0 Hz: q̇ is only limited
// If a joint has a stiffness, its link is connected to the servo by a spring (flexible_joint.hpp) and yields
// to contacts, such that the contact creates no energy for any stiffness (yielding.hpp); the other joints do
// not yield. The measured joint positions are those of the links, without error. The time is the argument of
// read(). If there is no setpoint, or if write() is not called for 20 ms, the servos brake at their
// acceleration limits and then hold their position until the next setpoint. Accessors named true_ and
// displace() are for the laboratory only.

#include <cstdint>
#include <optional>

#include "common/core/random.hpp"
#include "slave/config/slave_config.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "slave/sensing/tool_load.hpp"
#include "slave/simulation/force_sensor.hpp"
#include "slave/simulation/scene/bodies.hpp"
#include "slave/simulation/scene/scene.hpp"
#include "slave/simulation/simulated_robot.hpp"

namespace longreach {

class SimulatedArm final : public SimulatedRobot {
 public:
  /// Throws std::invalid_argument like Scene and Bodies.
  SimulatedArm(const SlaveConfig& config, Random random);

  RobotState read(Time now) override;
  /// A setpoint that is not finite is ignored and counted.
  void write(const std::optional<JointVector>& joint_setpoint_rad) override;
  /// The free bodies of the scene, measured without error at the last read().
  [[nodiscard]] BodyPoses tracked_bodies() const override;
  void grip(bool closed) override {
    if (bodies_) bodies_->grip(closed);
  }

  [[nodiscard]] const Pose& start_pose() const override {
    return X_WE_start_;
  }  // pose of the tool at start_rad
  [[nodiscard]] const Pose& true_pose() const override { return X_WE_; }
  [[nodiscard]] const Vector3& true_velocity() const override { return V_WE_.linear; }
  [[nodiscard]] const Wrench& true_wrench() const override { return F_E_W_; }
  [[nodiscard]] double true_penetration_m() const override { return contact_.depth_m; }
  /// Returns the static stiffness dF/dp of all contacts at `p_WE` along the outward direction, by finite
  /// differences, N/m; 0 in free space.
  [[nodiscard]] double material_stiffness(const Vector3& p_WE) const override;
  [[nodiscard]] const Bodies* bodies() const override { return bodies_ ? &*bodies_ : nullptr; }
  [[nodiscard]] Bodies* bodies() override { return bodies_ ? &*bodies_ : nullptr; }
  void displace(const JointVector& joint_rad) override;
  void surround(const SceneConfig& scene) override { scene_ = Scene(scene, X_WE_start_); }
  [[nodiscard]] bool watchdog_stopped() const override { return stopped_; }
  [[nodiscard]] std::uint64_t rejected_setpoints() const override { return rejected_; }

 private:
  void move(double dt);
  void feel(double dt);
  Wrench sense(double dt);

  RobotConfig robot_;
  SensingConfig sensing_;
  Kinematics kinematics_;
  Pose X_WE_start_;
  Scene scene_;
  std::optional<Bodies> bodies_;
  ForceSensor sensor_;
  SensorMotionEstimate motion_{};
  std::optional<Time> now_{};
  double t_s_ = 0.0;  // time since the first read
  std::optional<Time> written_{};
  JointVector joint_rad_;
  JointVector joint_rad_per_s_ = JointVector::Zero();
  JointVector servo_rad_;
  JointVector servo_rad_per_s_ = JointVector::Zero();
  std::optional<JointVector> setpoint_rad_{};
  bool flexible_;  // at least one joint has a stiffness
  Pose X_WE_{};
  Twist V_WE_{};
  Wrench F_E_W_{};
  SceneContact contact_{};
  bool stopped_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace longreach
