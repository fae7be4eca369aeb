#pragma once
// Connects the simulated DELTA device to a wall by a comparison law, in one dimension: along the vertical
// through home, with the wall below. The device and the hand are those of the laboratory, but without Coulomb
// friction, encoder quantization, motor lag and weight. The link is a pure delay at 1 kHz. The tool is an
// ideal position servo, which the coupling of the law moves against the wall F = K p.
//
// In addition to the link, the loop has a delay of two samples: one from the servo and one from the order in
// which the two sides are stepped.

#include <cmath>
#include <cstdint>

#include "deploy/lab/comparison/comparison_law.hpp"
#include "deploy/lab/comparison/coupling.hpp"
#include "deploy/lab/delay/delay_line.hpp"
#include "master/devices/delta/delta_handle.hpp"
#include "master/simulation/simulated_delta.hpp"

namespace longreach {

struct BilateralCase {
  RenderingLaw law = RenderingLaw::kDirect;
  ComparisonConfig config{};
  DeviceConfig device{};
  Grip grip = Grip::kLight;
  double rtt_s = 0.3;
  double wall_n_per_m = 1000.0;
  double jitter_s = 0.0;  // standard deviation, per direction
  double loss = 0.0;
  std::uint64_t seed = 1;
};

inline constexpr double kBenchPeriod_s = 1e-3;
inline constexpr int kBenchLoopSamples = 2;
/// Total delay of the loop, s, including half a sample for the zero-order hold of the force.
inline double bench_loop_s(double rtt_s) { return rtt_s + (kBenchLoopSamples + 0.5) * kBenchPeriod_s; }
inline int bench_samples(double time_s) { return static_cast<int>(std::lround(time_s / kBenchPeriod_s)); }

class BilateralBench {
 public:
  explicit BilateralBench(const BilateralCase& c);

  /// Runs one sample: the hand's spring pulls towards `hand_depth_m`, and the hand pushes downwards with
  /// `press_n`.
  void step(double hand_depth_m, double press_n);

  /// Holds the handle at `depth_m` until all data in the link corresponds to that depth, then releases it at
  /// `from_m`.
  void settle(double depth_m, double from_m);

  [[nodiscard]] double depth_m() const { return -device_.position_m().z(); }
  [[nodiscard]] double tool_depth_m() const { return -tool_m_.z(); }
  /// Rendered force, positive against the push of the hand.
  [[nodiscard]] double force_n() const { return force_n_.z(); }
  /// Energy from the hand into the device, the sum of -F[k-1] (x[k] - x[k-1]).
  [[nodiscard]] double port_energy_j() const { return port_j_; }
  [[nodiscard]] double wall_energy_j() const;

 private:
  void communicate();

  BilateralCase case_;
  HandModel hand_;
  SimulatedDelta device_;
  DeltaHandle handle_;
  ComparisonLaw law_;
  Coupling coupling_;
  DelayLine<ComparisonCommand> up_;
  DelayLine<ComparisonReport> down_;
  Vector3 handle_m_ = Vector3::Zero();
  Vector3 tool_m_ = Vector3::Zero();
  Vector3 force_n_ = Vector3::Zero();
  double port_j_ = 0.0;
};

/// Creates the slave side of a law.
Coupling make_coupling(RenderingLaw law, const ComparisonConfig& config);

}  // namespace longreach
