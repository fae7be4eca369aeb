#pragma once
// A random contact of which the slave has no model: link, hand, scale, sensor and material are drawn from a seed.
// Measures how accurately the contact is displayed when the simulated operator presses and probes the surface.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "schema/config_master.hpp"

namespace longreach {

/// Force law of the material: the Hunt-Crossley family, and three laws outside it.
enum class MaterialKind { kHuntCrossley, kProgressive, kLayered, kHysteretic };

struct UnknownCell {
  std::string link;
  Grip grip = Grip::kLight;
  MaterialKind kind = MaterialKind::kHuntCrossley;
  double slope_n_per_m = 0.0;  // tangent stiffness of the material at the mean pressing force
  double n = 1.0;
  double damping_s_per_m = 0.0;  // λ/k
  double scale = 1.0;            // k_scale
  double noise_n = 0.0;          // standard deviation of the sensor
  double tool_n = 0.0;           // mean pressing force at the tool
  double probe_share = 0.0;      // amplitude of the probing relative to tool_n

  /// Elastic force (N) and tangent stiffness (N/m) at the tool for a depth in m. For a hysteretic material,
  /// these are the means of the loading and unloading curves.
  [[nodiscard]] double elastic_n(double depth_m) const;
  [[nodiscard]] double tangent_n_per_m(double depth_m) const;
  /// Measured force without noise, N.
  [[nodiscard]] double force_n(double depth_m, double speed_m_per_s) const;
  [[nodiscard]] double depth_m() const;  // depth at the force tool_n
};

UnknownCell draw_cell(Random& random, MaterialKind kind);
/// Draws a contact that is pressed lightly, with 0.5 N ± 0.25 N. The link alternates between `lab` and
/// `moon`.
UnknownCell draw_light_cell(Random& random, std::size_t index);

/// Results of a cell, evaluated during and at the end of the last two probing cycles.
struct UnknownResult {
  bool probed = false;
  double slope_error = 1.0, force_error = 1.0;  // measured at the hand; relative, signed
  /// Signed error and standard deviation of the reported stiffness at the depth of the report, both relative.
  double reported_error = 1.0, reported_sd = 1.0;
  double estimate_error = 1.0, estimate_sd = 1.0, bound_sd = 0.0;
  bool power_law = true;  // final verdict of the estimator
  // Time from the first touch until the first estimate is available: from the estimator, from FIXED_EXPONENT
  // with the true exponent, and according to the Cramér-Rao bound.
  double first_s = -1.0, fixed_first_s = -1.0, bound_first_s = -1.0;
  double rtt_s = 0.0;
  double returned_j = 0.0;                  // maximum net energy from the device into the hand
  double ripple_m = 0.0;                    // motion of the resting hand after probing
  std::uint32_t contacts = 0, presses = 0;  // number of contacts reported by the slave; actual number
};

/// Deviations from the defaults, for comparisons and for controls that must fail.
struct CellSettings {
  bool fixed_too = false;         // also measure fixed_first_s
  double assumed_exponent = 0.0;  // use FIXED_EXPONENT with this value; 0: estimate the exponent
  /// The rendered stiffness does not follow the force; it remains at the value for a typical force.
  bool never_follows = false;
  double noise_unreported = 1.0;  // actual noise of the sensor relative to the configured noise
};

UnknownResult run_cell(const ExperimentRun& run, const UnknownCell& cell, const CellSettings& settings);

}  // namespace longreach
