#pragma once
// The simulated devices, the simulated hand and who moves it. Meaning, unit and range: proto/config.proto;
// the same names.

#include <cstdint>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct DeviceConfig {
  double mass_kg = 0.2;
  double damping_n_s_per_m = 3.5;
  double inertia_kg_m2 = 1.27e-4;
  double rotational_damping_nm_s_per_rad = 4.775e-3;
  double resolution_m = 1e-5;
  double resolution_rad = 1e-4;
  double workspace_m = 0.075;
  double workspace_rad = 0.8;
  double force_max_n = 20.0;
  double moment_max_nm = 0.5;
};

enum class Grip : std::uint8_t { kLight = 0, kFirm = 1, kReleased = 2 };

struct HandConfig {
  Grip grip = Grip::kLight;
};

enum class OperatorKind : std::uint8_t { kNone = 0, kScript = 1, kKeyboard = 2 };

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
};

}  // namespace longreach
