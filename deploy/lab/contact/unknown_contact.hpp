#pragma once
// A contact without a model for the slave, drawn from a seed: link, hand, scale, sensor and material; and its
// display when the simulated operator presses and probes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/config/device_config.hpp"

namespace longreach {

/// Force of the material over depth and speed: the Hunt-Crossley family, and three materials outside it.
enum class MaterialKind { kHuntCrossley, kProgressive, kLayered, kHysteretic };

struct UnknownCell {
  std::string link;
  Grip grip = Grip::kLight;
  MaterialKind kind = MaterialKind::kHuntCrossley;
  double slope_n_per_m = 0.0;  // of the material at the mean force of the press
  double n = 1.0;
  double damping_s_per_m = 0.0;  // λ/k
  double scale = 1.0;            // k_scale
  double noise_n = 0.0;          // sd of the sensor
  double tool_n = 0.0;           // mean force of the press, at the tool
  double probe_share = 0.0;      // amplitude of the probing relative to that

  /// Elastic force and stiffness at the tool, N and N/m; depth in m. For a hysteretic material the mean of
  /// loading and unloading.
  [[nodiscard]] double elastic_n(double depth_m) const;
  [[nodiscard]] double tangent_n_per_m(double depth_m) const;
  /// Measured force without noise, N.
  [[nodiscard]] double force_n(double depth_m, double speed_m_per_s) const;
  [[nodiscard]] double depth_m() const;  // at `tool_n`
};

UnknownCell draw_cell(Random& random, MaterialKind kind);
/// Pressed with 0.5 N ± 0.25 N, over `lab` and `moon` alternately.
UnknownCell draw_light_cell(Random& random, std::size_t index);

/// Results of a cell, over the last two cycles of the probing and at their end.
struct UnknownResult {
  bool probed = false;
  double slope_error = 1.0, force_error = 1.0;     // at the hand, relative, signed
  double reported_error = 1.0, reported_sd = 1.0;  // of the reported stiffness at its depth, relative; signed
  double estimate_error = 1.0, estimate_sd = 1.0, bound_sd = 0.0;
  bool power_law = true;  // verdict at the end
  // From the first touch to the first value; for FIXED_EXPONENT with the true exponent; for the bound.
  double first_s = -1.0, fixed_first_s = -1.0, bound_first_s = -1.0;
  double rtt_s = 0.0;
  double returned_j = 0.0;                  // maximum net energy from the device into the hand
  double ripple_m = 0.0;                    // of a hand at rest after the probing
  std::uint32_t contacts = 0, presses = 0;  // found by the slave; actual number
};

/// Differences from the defaults: for comparison, and for controls that must fail.
struct CellSettings {
  bool fixed_too = false;         // also determine `fixed_first_s`
  double assumed_exponent = 0.0;  // FIXED_EXPONENT with this value; 0: unknown
  bool never_follows = false;     // the stiffness stays at that of a usual force
  double noise_unreported = 1.0;  // actual noise of the sensor relative to the configured noise
};

UnknownResult run_cell(const ExperimentRun& run, const UnknownCell& cell, const CellSettings& settings);

}  // namespace longreach
