#pragma once
// Description of a robot, as read from its file. proto/config.proto documents the fields that have no comment here.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "slave/robot/robot.hpp"

namespace longreach {

/// Convention of the rows of the table: A = Rz(q + theta) Tz(d) Tx(a) Rx(alpha) (Denavit, Hartenberg 1955),
/// or A = Rx(alpha) Tx(a) Rz(q + theta) Tz(d) (Craig).
enum class DhConvention : std::uint8_t { kStandard, kModified };

enum class JointKind : std::uint8_t {
  kRevolute,
  kPrismatic,  // q is added to d instead of theta; fields ending in _rad are in m
  kFixed       // the joint does not move: q is 0
};

/// Criterion that selects one of the solutions within the joint limits.
enum class BranchPreference : std::uint8_t {
  kNearest,  // smallest distance in joint space from the current joint positions
  kSoonest,  // shortest travel time of the slowest joint at its speed limit
  kCentred   // largest distance from the joint limits
};

/// Row of a Denavit-Hartenberg table and the limits of the joint.
struct JointConfig {
  double a_m = 0.0;
  double alpha_rad = 0.0;
  double d_m = 0.0;
  double theta_rad = 0.0;
  double min_rad = -3.14159;
  double max_rad = 3.14159;
  double speed_max_rad_per_s = 1.0;
  double acceleration_max_rad_per_s2 = 5.0;
  double start_rad = 0.0;
  JointKind kind = JointKind::kRevolute;
  /// Radius with which the link after the joint is drawn; 0: proportional to the size of the robot.
  double draw_radius_m = 0.0;
  double jerk_max_rad_per_s3 = 2500.0;
  // For the simulation only: the link is connected to its servo by a spring of this stiffness; 0: rigidly.
  double stiffness_nm_per_rad = 0.0;
  double damping_nm_s_per_rad = 0.0;
  double friction_nm = 0.0;
  double inertia_kg_m2 = 1.0;
  std::string name{};  // manufacturer's name for the joint
  /// Rotation Ry after Rx(alpha), with the standard convention only (Hayati).
  double beta_rad = 0.0;
};

/// Pose of one frame in another.
struct PlacementConfig {
  Vector3 position_m = Vector3::Zero();
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector
};

struct RobotConfig {
  std::string name;
  std::string basis;
  DhConvention convention = DhConvention::kStandard;
  std::array<JointConfig, kMaxJoints> joint{};
  PlacementConfig base{};  // frame in which the first row starts, in W
  PlacementConfig tool{};  // E in the frame of the last row
  BranchPreference prefer = BranchPreference::kNearest;
  double servo_hz = 10.0;  // bandwidth of the joint servos; 0: ideal
  double load_max_kg = 30.0;
  /// Start positions that override those of the rows; they are moved to the rows after the file has been
  /// read.
  std::vector<double> start_rad{};
  // For a URDF: the links between which the arm was read, and the limits that a URDF does not contain.
  std::string base_link{}, tip_link{};
  double acceleration_max_rad_per_s2 = 5.0;
  double jerk_max_rad_per_s3 = 2500.0;
};

}  // namespace longreach
