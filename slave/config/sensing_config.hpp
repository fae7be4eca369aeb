#pragma once
// Parameters of the force/torque sensor and of contact detection. proto/config.proto defines meaning, unit
// and range under the same names.

#include "common/spatial/spatial.hpp"

namespace longreach {

struct ToolLoadConfig {
  double mass_kg = 0.0;
  Vector3 com_m = Vector3::Zero();
  Vector3 inertia_kg_m2 = Vector3::Zero();
};

struct SensingConfig {
  double force_noise_n = 0.05;
  double moment_noise_nm = 0.005;
  double touch_n = 0.3;
  double release_n = 0.12;
  double filter_s = 0.01;
  double force_bias_n = 0.0, moment_bias_nm = 0.0;
  double force_drift_n = 0.0, moment_drift_nm = 0.0;
  double force_resolution_n = 0.0, moment_resolution_nm = 0.0;
  double force_range_n = 0.0, moment_range_nm = 0.0;
  double bandwidth_hz = 0.0;
  ToolLoadConfig tool{};
  Vector3 gravity_m_per_s2 = Vector3::Zero();
  double zero_s = 0.0;
  double touch_nm = 0.03;
  double release_nm = 0.012;
};

}  // namespace longreach
