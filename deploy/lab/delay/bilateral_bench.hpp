#pragma once
// A comparison law between the simulated DELTA device and a wall, in one dimension: along the vertical
// through home, downwards into the wall. Device and hand are those of the laboratory, without Coulomb
// friction, encoder steps, motor lag and weight; the link is a pure delay at 1 kHz; the tool is an ideal
// position servo, moved by the coupling of the law, in front of the wall F = K p.
//
// The loop has a delay of two samples besides the link: the servo and the order of the two sides.

#include <cmath>
#include <cstdint>

#include "deploy/lab/delay/delay_line.hpp"
#include "master/devices/delta/delta_handle.hpp"
#include "master/rendering/comparison/comparison_law.hpp"
#include "master/simulation/simulated_delta.hpp"
#include "slave/comparison/coupling.hpp"

namespace longreach {

struct BilateralCase {
  RenderingLaw law = RenderingLaw::kDirect;
  ComparisonConfig config{};
  DeviceConfig device{};
  Grip grip = Grip::kLight;
  double rtt_s = 0.3;
  double wall_n_per_m = 1000.0;
  double jitter_s = 0.0;  // of either direction
  double loss = 0.0;
  std::uint64_t seed = 1;
};

inline constexpr double kBenchPeriod_s = 1e-3;
inline constexpr int kBenchLoopSamples = 2;
/// Total delay of the loop, including half a sample for the held force.
inline double bench_loop_s(double rtt_s) { return rtt_s + (kBenchLoopSamples + 0.5) * kBenchPeriod_s; }
inline int bench_samples(double time_s) { return static_cast<int>(std::lround(time_s / kBenchPeriod_s)); }

class BilateralBench {
 public:
  explicit BilateralBench(const BilateralCase& c);

  /// One sample: the hand is attracted to `hand_depth_m` and pushes with `press_n` downwards.
  void step(double hand_depth_m, double press_n);

  /// Holds the handle there until all delayed data is consistent, then releases it at `from_m`.
  void settle(double depth_m, double from_m);

  [[nodiscard]] double depth_m() const { return -device_.position_m().z(); }
  [[nodiscard]] double tool_depth_m() const { return -tool_m_.z(); }
  [[nodiscard]] double force_n() const { return force_n_.z(); }  // rendered, against the hand's pushing
  /// From the hand into the device, -F[k-1] (x[k] - x[k-1]).
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

/// The part of a law at the slave.
Coupling make_coupling(RenderingLaw law, const ComparisonConfig& config);

}  // namespace longreach
