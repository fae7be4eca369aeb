#pragma once
// A robot and its surroundings in an MJCF file, or the arm of a URDF (urdf_arm.hpp), simulated by MuJoCo: joints, a force and a torque sensor at a site, and a
// gripper. The world of the file is W; the site is the tool frame E.
//
// The joints of the robot are those between the world and the site, in this order: hinges and slides. The force sensor and
// the torque sensor are those of the file at the site. MuJoCo measures between the body of the site and its parent, so this
// body has no joint. The readings are the wrench of the environment on the tool, along E, plus the weight and the inertia of
// that body and of what it carries, as at a real wrist.
//
// If every joint has a position actuator, the joints follow their setpoints by these. Otherwise, or with servo_hz, they follow
// by computed torque: the acceleration w² (q* - q) - 2 w q' with w = 2π servo_hz. Without a setpoint they keep the last one.

#include <mujoco/mujoco.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "common/spatial/joint_rows.hpp"
#include "common/spatial/spatial.hpp"
#include "deploy/mujoco/bodies.hpp"
#include "deploy/mujoco/surfaces.hpp"

namespace longreach {

struct MujocoOptions {
  std::string site = "tool";
  std::string tool_link{};  // of a URDF: the link that becomes E; empty: the only end link behind six joints
  double servo_hz = 0.0;    // bandwidth of the computed torque; 0: the actuators of the file, or 10 Hz
  double force_noise_n = 0.05;     // standard deviation, N
  double moment_noise_nm = 0.005;  // N m
  Wrench bias{};                   // constant error of the sensors, along E; N m, N
  std::uint64_t seed = 1;
  std::string gripper{};  // actuator that closes at the upper end of its control range; empty: no gripper
  // Beside what the file contains.
  std::vector<MujocoSurface> surfaces{};
  const MujocoBodies* bodies = nullptr;  // null: none
};

/// A joint of the robot as the file describes it.
struct MujocoJoint {
  std::string name;
  JointAxis axis{};             // in W, with all joints at zero
  double min = 0.0, max = 0.0;  // rad or m; both zero: not limited
  double start = 0.0;           // rad or m
};

/// What a geom exerts on the tool: the sum over its points of contact.
struct MujocoContact {
  int geom = -1;   // index in the file
  Wrench F_E_W{};  // moment about E and force on the tool, along W; N m, N
  Vector3 normal =
      Vector3::Zero();  // out of the geom, towards the tool, along W; mean, weighted with the forces
  Vector3 point_m = Vector3::Zero();  // in W; mean
  double normal_n = 0.0;              // sum of the normal forces, N
  double depth_m = 0.0;               // maximum penetration
};

class MujocoWorld {
 public:
  /// Throws std::invalid_argument "FILE:LINE: reason" or "FILE: reason" if the file is unsuitable.
  MujocoWorld(const std::string& file, const MujocoOptions& options);
  ~MujocoWorld();
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  [[nodiscard]] const std::vector<MujocoJoint>& joints() const { return joints_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The link of a URDF whose frame is E; empty for an MJCF file.
  [[nodiscard]] const std::string& tool_link() const { return options_.tool_link; }
  /// What of a URDF is not simulated, one sentence for each kind.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Bandwidth of the computed torque, Hz; 0: the actuators of the file move the joints.
  [[nodiscard]] double servo_hz() const { return options_.servo_hz; }
  /// Pose of the site in W with the joints at these positions; the other joints of the file are at their start.
  [[nodiscard]] Pose site_at(std::span<const double> joint) const;

  /// Sets the setpoints of the joints, rad or m.
  void follow(std::span<const double> setpoint);
  /// The setpoints become the present positions.
  void stop();
  /// Returns to the start: the first key frame, or the positions that the file states.
  void reset();
  /// Moves the joints of the robot to these positions, rad or m, where they are at rest and stay.
  void place(std::span<const double> joint);
  /// Lets the rest of the file come to rest while the robot stays where it is.
  void settle(double seconds);
  void grip(bool closed);
  /// Advances by `seconds`, a multiple of the time step of the file. Throws std::runtime_error if the simulation diverges.
  void step(double seconds);
  [[nodiscard]] double time_step_s() const;

  [[nodiscard]] std::vector<double> positions() const;
  [[nodiscard]] std::vector<double> speeds() const;
  /// The readings of the sensors with bias and noise, along E.
  Wrench measured();
  /// The same without bias and noise: the mean over the time of the last step(), as a sensor measures it.
  [[nodiscard]] const Wrench& wrench() const { return sensed_; }

  /// The geoms that touch the tool, which is what the sensors carry: the body of the site and the bodies on it. At the
  /// beginning of the last time step.
  [[nodiscard]] std::vector<MujocoContact> contacts() const;
  /// The name of a geom; that of its body if it has none.
  [[nodiscard]] std::string geom_name(int geom) const;
  /// Static compliance of the springs in the joints that carry the touching geom, at the point and along the normal of
  /// the contact, m/N. 0: the geom is fixed. Infinite: a joint without a spring yields.
  [[nodiscard]] double spring_compliance(const MujocoContact& contact) const;
  /// What contacts and welds exert on the bodies that the sensors carry: moment about E and force, along W. At the beginning
  /// of the last time step.
  [[nodiscard]] Wrench external_wrench() const;
  /// For drawing.
  [[nodiscard]] const mjModel& model() const { return *model_; }
  [[nodiscard]] const mjData& data() const { return *data_; }
  /// For what MuJoCo does not have; call mj_forward after a change of the state.
  [[nodiscard]] mjModel& changeable_model() { return *model_; }
  [[nodiscard]] mjData& changeable_data() { return *data_; }
  /// 64-bit FNV-1a hash of the compiled model, which contains the included files and the meshes.
  [[nodiscard]] std::uint64_t fingerprint() const;

 private:
  void to_start();
  void take_joints();
  void take_sensors();
  void take_actuators();
  void compute_torque();
  void check_numbers() const;
  [[nodiscard]] bool of_tool(int geom) const;

  std::string file_;
  MujocoOptions options_;
  std::vector<std::string> notes_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  std::string name_;
  int site_ = -1, gripper_ = -1;
  std::vector<MujocoJoint> joints_;
  std::vector<int> number_, actuator_;  // of each joint
  int force_at_ = 0, torque_at_ = 0;    // in the array of sensors
  std::vector<double> setpoint_, wanted_, torque_;
  Wrench sensed_{};
  Random random_;
};

}  // namespace longreach
