#pragma once
// Parameters of the rendering. Each field is documented under the same name in proto/config.proto.

#include <cstdint>

namespace longreach {

enum class RenderingLaw : std::uint8_t {
  kStiffness = 0,
  kNaive = 1,
  kDirect = 2,  // this and the following laws exist only in the laboratory
  kPositionPosition = 3,
  kWave = 4,
  kTdpa = 5,
  kTank = 6
};

enum class Registration : std::uint8_t { kTouch = 0, kArrival = 1 };

struct RenderingConfig {
  RenderingLaw law = RenderingLaw::kStiffness;
  double ke = 1.0;
  double contact_damping_n_s_per_m = 3.0;
  double stiffness_max_n_per_m = 7000.0;
  double fade_s = 0.2;
  double tank_max_j = 0.02;
  double store_j = 0.02;
  double rate_stiffness_n_per_m = 60.0;
  double rate_damping_n_s_per_m = 4.0;
  double friction_n = 0.1;
  double friction_stiffness_n_per_m = 1000.0;
  double rotational_stiffness_nm_per_rad = 0.45837;
  double rotational_damping_nm_s_per_rad = 1.05e-2;
  double ke_rotation = 1.0;
  double contact_damping_nm_s_per_rad = 1e-3;
  double stiffness_max_nm_per_rad = 10.0;
  Registration registration = Registration::kTouch;
  double slew_n_per_s = 5000.0;
  double slew_nm_per_s = 200.0;
  double force_max_n = 15.0;
  double moment_max_nm = 0.3;
  double ramp_s = 0.05;
  double load_factor = 1.5;
  double friction_nm = 0.003;
  double friction_stiffness_nm_per_rad = 1.0;
  bool home_spring = false;
  bool ke_by_scale = false;
  double rate_force_ratio = 0.1;
};

/// Maximum energy that the port may return beyond what it received since the start of an engagement, J. This
/// is the initial store plus the apparent energy that encoder quantization can produce without a real leak.
inline double returned_most_j(const RenderingConfig& c = {}) {
  constexpr double kSteps_j = 1e-3;
  return c.store_j + kSteps_j;
}

}  // namespace longreach
