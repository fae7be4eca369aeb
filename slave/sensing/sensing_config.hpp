#pragma once
// Parameters of the force/torque sensor and of contact detection. Meaning, unit and range:
// proto/config.proto; the same names.

namespace longreach {

struct SensingConfig {
  double force_noise_n = 0.05;
  double moment_noise_nm = 0.005;
  double touch_n = 0.3;
  double release_n = 0.12;
  double filter_s = 0.01;
};

}  // namespace longreach
