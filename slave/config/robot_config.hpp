#pragma once
// A robot as described by its file.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "slave/robot/robot.hpp"

namespace longreach {

/// Convention of the rows: A = Rz(q + theta) Tz(d) Tx(a) Rx(alpha) (Denavit, Hartenberg 1955), or A =
/// Rx(alpha) Tx(a) Rz(q + theta) Tz(d) (Craig).
enum class DhConvention : std::uint8_t { kStandard, kModified };

enum class JointKind : std::uint8_t {
  kRevolute,
  kPrismatic,  // q adds to d instead of theta: its fields _rad are in m
  kFixed       // does not move: q counts as 0
};

/// Choice among the solutions within the joint limits.
enum class BranchPreference : std::uint8_t {
  kNearest,  // minimum distance in joint space from the present joints
  kSoonest,  // minimum time of the slowest joint at its speed limit
  kCentred   // maximum distance from the joint limits
};

/// Row of a Denavit-Hartenberg table and the joint's limits.
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
  double draw_radius_m = 0.0;  // of the drawn link after the joint; 0: in proportion to the robot
  double jerk_max_rad_per_s3 = 2500.0;
  // Simulation only: a link on a spring behind its servo; 0: rigid.
  double stiffness_nm_per_rad = 0.0;
  double damping_nm_s_per_rad = 0.0;
  double friction_nm = 0.0;
  double inertia_kg_m2 = 1.0;
  std::string name{};     // as its maker calls it
  double beta_rad = 0.0;  // Ry behind Rx(alpha), of the standard convention alone (Hayati)
};

/// Where one frame is in another.
struct PlacementConfig {
  Vector3 position_m = Vector3::Zero();
  Vector3 rotation_rad = Vector3::Zero();  // rotation vector
};

struct RobotConfig {
  std::string name;
  std::string basis;
  DhConvention convention = DhConvention::kStandard;
  std::array<JointConfig, kMaxJoints> joint{};
  PlacementConfig base{};  // where the first row begins, in W
  PlacementConfig tool{};  // E in the frame of the last row
  BranchPreference prefer = BranchPreference::kNearest;
  double servo_hz = 10.0;  // bandwidth of the joint servos; 0: ideal
  double load_max_kg = 30.0;
  std::vector<double> start_rad{};  // instead of that of the joints; once files are read it is theirs
  // Of a URDF: what was read, and what it lacks.
  std::string base_link{}, tip_link{};
  double acceleration_max_rad_per_s2 = 5.0;
  double jerk_max_rad_per_s3 = 2500.0;
};

}  // namespace longreach
