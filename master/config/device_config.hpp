#pragma once
// Parameters of the simulated devices, the simulated hand and its operator. Each field is documented under
// the same name in proto/config.proto. The defaults here equal deploy/devices/desktop.txtpb.

#include <cstdint>
#include <string>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// One motor axis. All three axes of a device have the same parameters.
struct DriveConfig {
  double inertia_kg_m2 = 3e-4;
  double viscous_nm_s_per_rad = 0.075;
  double coulomb_nm = 0.006;
  double resolution_rad = 9.587379924285257e-05;
  double torque_max_nm = 2.5;
  double bandwidth_hz = 2000.0;
};

struct DeltaConfig {
  double arm_m = 0.11;
  double rod_m = 0.2;
  double radius_m = 0.06;
  double offset_m = 0.0;
  double side_m = 0.0;
  bool upwards = false;
  Vector3 azimuth_rad{0.0, 2.0943951023931953, 4.1887902047863905};
  double home_height_m = 0.17;
  double platform_kg = 0.12;
  double arm_kg = 0.1;
  double arm_com_fraction = 0.4;
  double forearm_kg = 0.05;
  DriveConfig drive{};
  double workspace_m = 0.075;
};

struct SphericalConfig {
  double alpha1_rad = 1.5707963267948966;
  double alpha2_rad = 1.5707963267948966;
  double beta1_rad = 0.9553166181245093;
  double beta2_rad = 0.9553166181245093;
  double inertia_kg_m2 = 1e-4;
  DriveConfig drive{
      .inertia_kg_m2 = 4.8e-5, .viscous_nm_s_per_rad = 2.5e-3, .coulomb_nm = 0.001, .torque_max_nm = 0.5};
  double workspace_rad = 0.8;
};

enum class IdleRule : std::uint8_t { kHome = 0, kStay = 1 };
enum class HandleMotion : std::uint8_t { kCoupled = 0, kDecoupled = 1 };

struct BehaviourConfig {
  IdleRule idle = IdleRule::kHome;
  HandleMotion motion = HandleMotion::kCoupled;
  double home_n_per_m = 100.0;
  double home_n_s_per_m = 4.0;
  double home_speed_m_per_s = 0.05;
  double home_nm_per_rad = 0.45837;
  double home_nm_s_per_rad = 0.0105;
  double home_speed_rad_per_s = 1.0;
  double guide_n_per_m = 500.0;
  double guide_nm_per_rad = 0.45837;
  double free_m = 0.003;
  double free_rad = 0.03;
  double stop_share = 0.93;
  double stop_n_per_m = 1500.0;
  double stop_nm_per_rad = 1.0;
};

struct DeviceConfig {
  std::string name;
  std::string basis;
  DeltaConfig delta{};
  SphericalConfig spherical{};
  Vector3 gravity_m_per_s2{0.0, 0.0, -9.81};
  bool gravity_compensation = true;
  std::uint32_t delay_samples = 0;
  double velocity_filter_s = 0.002;
  BehaviourConfig behaviour{};
  bool turns = true;
};

enum class Grip : std::uint8_t { kLight = 0, kFirm = 1, kReleased = 2 };

struct HandConfig {
  Grip grip = Grip::kLight;
};

enum class OperatorKind : std::uint8_t {
  kNone = 0,
  kScript = 1,
  kKeyboard = 2,
  kGamepad = 3,
  kSpaceMouse = 4
};

struct OperatorConfig {
  OperatorKind kind = OperatorKind::kScript;
  double rate_distance_m = 0.1;
  double approach_speed_m_per_s = 0.003;
  double press_n = 3.0;
  double probe_n = 1.5;
  double probe_hz = 0.25;
  std::uint32_t probe_cycles = 3;
  Vector3 direction = Vector3::UnitX();
  double reaction_s = 0.25;
  double dead_zone = 0.12;
  double reach_m = 0.04;
  double reach_rad = 0.4;
  double speed_m_per_s = 0.03;
  double speed_rad_per_s = 0.4;
  std::string pad;
  double rumble = 1.0;
};

}  // namespace longreach
