#pragma once
// The robot of an MJCF file (deploy/mujoco/world.hpp) in virtual time. It advances by the time between two reads, in time
// steps of the file. The joints follow by the position actuators of the file, or by computed torque with robot.servo_hz.
// They begin at the start positions of the configuration; the rest of the file begins at its first key frame. The planes and
// boxes of the scene are added to the file as blocks on springs (deploy/mujoco/surfaces.hpp), its free bodies with their
// gripper and latch, which then is the tool (deploy/mujoco/bodies.hpp).
//
// The slave receives the joint positions and speeds and what a sensor at the site measures: MuJoCo's force and torque
// sensor, with the bandwidth, noise, bias, resolution and range of sensing. This contains the weight and the inertia of the
// body of the site. The accessors named true_, and touched(), are for the laboratory alone: they come from the contacts.
// Without a setpoint, or if write() is not called for 20 ms, the joints keep their present positions.
//
// The stiffness at a place is that of the geom that touched the tool nearest to it: the springs in the joints that carry
// this geom, in series with MuJoCo's penetration per force, a mean over the last 0.1 s of contact. The value follows changes
// beyond 1 %, so that that of a constant spring is constant. Gripper actuators do not move.

#include <optional>
#include <vector>

#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/robot/mujoco_free_bodies.hpp"
#include "deploy/mujoco/world.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "slave/simulation/force_sensor.hpp"

namespace longreach {

class MujocoArm final : public SimulatedRobot {
 public:
  /// `config.robot` must describe the robot of config.robot.mjcf. Throws std::invalid_argument "FILE: reason",
  /// UnsuitableScene for a scene that MuJoCo does not get.
  MujocoArm(const SlaveConfig& config, Random random);

  /// Throws std::runtime_error if the simulation diverges.
  RobotState read(Time now) override;
  /// A setpoint that is not finite is ignored and counted.
  void write(const std::optional<JointVector>& joint_setpoint_rad) override;
  /// The free bodies of the scene, measured without error at the last read().
  [[nodiscard]] BodyPoses tracked_bodies() const override;
  void grip(bool closed) override {
    if (bodies_) bodies_->grip(closed);
  }

  [[nodiscard]] const Pose& start_pose() const override { return X_WE_start_; }
  [[nodiscard]] const Pose& true_pose() const override { return X_WE_; }
  [[nodiscard]] const Vector3& true_velocity() const override { return V_WE_.linear; }
  [[nodiscard]] const Wrench& true_wrench() const override { return F_E_W_; }
  /// Maximum penetration of MuJoCo's contacts, without the deflection of springs in the file.
  [[nodiscard]] double true_penetration_m() const override { return depth_m_; }
  [[nodiscard]] double material_stiffness(const Vector3& p_WE) const override;
  void displace(const JointVector& joint_rad) override;
  [[nodiscard]] bool watchdog_stopped() const override { return stopped_; }
  [[nodiscard]] std::uint64_t rejected_setpoints() const override { return rejected_; }
  [[nodiscard]] std::vector<TouchedGeom> touched() const override;
  [[nodiscard]] const FreeBodies* bodies() const override { return bodies_ ? &*bodies_ : nullptr; }
  [[nodiscard]] FreeBodies* bodies() override { return bodies_ ? &*bodies_ : nullptr; }
  /// Throws std::invalid_argument: the surroundings are those of the file.
  void surround(const SceneConfig& scene) override;

 private:
  /// What is known of a geom since its first contact.
  struct Known {
    int geom;
    TouchedGeom seen;
    Vector3 tool_m = Vector3::Zero();  // position of the tool at the last contact, in W
    double stiffness_n_per_m = 0.0;
    double depth_sum_m = 0.0, force_sum_n = 0.0;  // of the last 0.1 s of contact
  };
  void feel(double dt);

  SensingConfig sensing_;
  Kinematics kinematics_;
  JointVector joint_rad_, joint_rad_per_s_ = JointVector::Zero();
  Pose X_WE_start_, X_WE_;
  std::optional<MujocoBodies> added_{};  // to the file
  MujocoWorld world_;
  std::optional<MujocoFreeBodies> bodies_{};
  ForceSensor sensor_;
  Twist V_WE_{};
  Wrench F_E_W_{};
  double depth_m_ = 0.0;
  std::vector<Known> known_;
  std::optional<Time> now_{}, written_{};
  bool follows_ = false, stopped_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace longreach
