#pragma once
// What the laboratory asks a simulated robot beyond the interface of a robot: the truth of its simulation. The slave
// never sees it. Implemented by SimulatedArm (the scenes of longreach) and by the laboratory's MujocoArm.

#include <cstdint>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "slave/config/slave_config.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

class FreeBodies;

/// What the tool has touched: a geometry of an MJCF file.
struct TouchedGeom {
  std::string name;          // of the geom, or of its body if the geom has no name
  double force_n = 0.0;      // magnitude of its force on the tool at the last read, N
  double force_max_n = 0.0;  // maximum of this magnitude since the start, N
  double depth_max_m = 0.0;  // maximum penetration since the start, m
};

class SimulatedRobot : public Robot {
 public:
  /// Pose of the tool E in W at the start.
  [[nodiscard]] virtual const Pose& start_pose() const = 0;
  /// Pose of the tool E in W at the last read.
  [[nodiscard]] virtual const Pose& true_pose() const = 0;
  /// Velocity of E in W at the last read, m/s.
  [[nodiscard]] virtual const Vector3& true_velocity() const = 0;
  /// Wrench of the environment on the tool at E in W at the last read, without noise, N m and N.
  [[nodiscard]] virtual const Wrench& true_wrench() const = 0;
  /// Maximum penetration of the tool into what it touches, m; 0: no contact.
  [[nodiscard]] virtual double true_penetration_m() const = 0;
  /// Static stiffness of what the tool touches at the position `p_WE` of the tool, along the normal there, N/m; 0 in
  /// free space.
  [[nodiscard]] virtual double material_stiffness(const Vector3& p_WE) const = 0;
  /// Moves the joints externally, rad or m; afterwards they are at rest at this position.
  virtual void displace(const JointVector& joint_rad) = 0;
  /// Whether the robot has stopped by itself because it received no setpoint.
  [[nodiscard]] virtual bool watchdog_stopped() const = 0;
  /// Number of setpoints that were ignored because they were not finite.
  [[nodiscard]] virtual std::uint64_t rejected_setpoints() const = 0;

  /// The geoms that have touched the tool, in the order of their first contact; empty for a scene of longreach.
  [[nodiscard]] virtual std::vector<TouchedGeom> touched() const { return {}; }
  /// The free-floating bodies of a scene of longreach; null if there are none.
  [[nodiscard]] virtual const FreeBodies* bodies() const { return nullptr; }
  [[nodiscard]] virtual FreeBodies* bodies() { return nullptr; }
  /// Replaces the scene. Throws std::invalid_argument if the scene is invalid, or if the robot has no scene of longreach.
  virtual void surround(const SceneConfig& scene) = 0;
};

}  // namespace longreach
