#pragma once
// Objects that the robot can touch, as described by the scene file.

#include <optional>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "slave/config/bodies_config.hpp"

namespace longreach {

/// Hunt-Crossley material, F = k p^n (1 + a v) at the penetration p; `stiffness_n_per_m` is the secant F/p at
/// the reference depth.
struct MaterialConfig {
  std::string name;
  double stiffness_n_per_m = 1000.0;
  double reference_depth_m = 0.001;
  double exponent = 1.0;
  double damping_s_per_m = 0.1;  // a = lambda/k
};

/// Infinite plane; the solid lies behind it.
struct PlaneConfig {
  Vector3 point_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitX();  // outward normal; need not be a unit vector
  /// True if `point_m` is relative to the start position of the tool.
  bool from_tool_start = true;
};

struct SphereConfig {
  Vector3 centre_m = Vector3::Zero();
  double radius_m = 0.02;
  bool from_tool_start = true;
};

struct BoxConfig {
  Vector3 centre_m = Vector3::Zero();
  Vector3 size_m = Vector3::Constant(0.04);  // edge lengths
  Vector3 rotation_rad = Vector3::Zero();    // rotation vector in W
  bool from_tool_start = true;
};

/// Solid cylinder with flat ends.
struct CylinderConfig {
  Vector3 centre_m = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();  // need not be a unit vector
  double radius_m = 0.02;
  double length_m = 0.1;
  bool from_tool_start = true;
};

/// Rotational stop: a lever on the tool touches it when the tool has rotated by `angle_rad` from its start
/// pose.
struct HingeConfig {
  Vector3 axis = Vector3::UnitZ();  // axis in W; need not be a unit vector
  double angle_rad = 0.05;
  double arm_m = 0.1;  // length of the lever
};

/// p(t) = p + velocity t + amplitude sin(2π frequency t)
struct MovementConfig {
  Vector3 velocity_m_per_s = Vector3::Zero();
  Vector3 amplitude_m = Vector3::Zero();
  double frequency_hz = 0.0;
};

/// A surface; exactly one of the shapes is set.
struct SurfaceConfig {
  std::string name;
  std::string material;  // name of the material
  std::optional<PlaneConfig> plane{};
  std::optional<SphereConfig> sphere{};
  std::optional<BoxConfig> box{};
  std::optional<CylinderConfig> cylinder{};
  std::optional<HingeConfig> hinge{};
  /// Surfaces with the same body form a union; if empty, the surface is a separate body.
  std::string body{};
  std::optional<MovementConfig> movement{};
};

struct WaypointConfig {
  Vector3 point_m = Vector3::Zero();
};

/// Path of straight segments with a rounded corner at each inner waypoint.
struct PathConfig {
  std::vector<WaypointConfig> waypoint;
  double turn_radius_m = 0.02;
  bool from_tool_start = true;
};

struct SceneConfig {
  std::string name;
  std::vector<MaterialConfig> material;
  std::vector<SurfaceConfig> surface;
  std::string basis;
  std::string robot_file;      // robot for which the scene was designed
  double tool_radius_m = 0.0;  // 0: the tool is a point
  std::optional<PathConfig> path{};
  std::optional<BodiesConfig> bodies{};
};

}  // namespace longreach
