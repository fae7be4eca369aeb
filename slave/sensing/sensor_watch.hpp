#pragma once
// The force sensor is a witness: each sample is judged before anything believes it. A fault is what no
// contact could do; T is the time since the sample before, v the tool's speed, σ noise, r resolution, R range
// as configured, G force_guard_n, k_max guard_stiffness_n_per_m, m the mass of the tool:
//
//   kind       judged                        a fault when                                         told after
//   nonsense   each sample                   a number is not finite                               1 sample
//   range      each channel of a sample      beyond R + r; R = 0: beyond 1e5 N + 2 m (|g| + a)    1 sample
//   leap       compensated force, away from  more than G + 10 σ + 2 r + u + T (k_hard v + k_max   1 sample
//              what it was, or from none     0.1 m/s), k_hard = 1e7 N/m: steel on steel
//   saturated  each channel                  at its range without a break                         50 ms
//   frozen     all channels, σ > r/2         the same to the last digit, not zero, while the      50 ms and 1 mm
//                                            tool goes on
// u is what the tool's acceleration explains where it is not known (tool_load.hpp). A force may vanish at
// once: a latch, an edge. Not revealed by any of these, with what it can do: a sensor that is frozen in free
// space or at rest, a bias, a drift, a scale. What they make the robot do ends with its relief (retreat_budget.hpp).

#include <optional>

#include "slave/config/command_config.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

class SensorWatch {
 public:
  SensorWatch(const SensingConfig& sensing, const CommandConfig& command)
      : sensing_(sensing), command_(command) {}
  void configure(const SensingConfig& sensing, const CommandConfig& command);

  struct Motion {
    Vector3 p_WE = Vector3::Zero();  // measured, m
    double speed_m_per_s = 0.0;
    double elapsed_s = 0.0;  // since the sample before
  };

  /// As it was read, along the axes of the tool. True: it may be believed.
  bool read(const Wrench& reading, const Motion& motion);
  /// What is left of it when the tool and bias are taken out, in W; `doubt_n` is u. True: likewise.
  bool felt(const Vector3& force_n, const Motion& motion, double uncertainty_n);

 private:
  [[nodiscard]] bool in_range(const Wrench& reading) const;
  [[nodiscard]] bool saturates(const Wrench& reading) const;
  [[nodiscard]] bool repeats(const Wrench& reading) const;
  [[nodiscard]] double leap_max_n(const Motion& motion) const;

  SensingConfig sensing_;
  CommandConfig command_;
  std::optional<Wrench> read_{};   // last
  std::optional<Vector3> felt_{};  // last, N
  double saturated_s_ = 0.0;
  double same_s_ = 0.0, same_m_ = 0.0;
  Vector3 p_WE_ = Vector3::Zero();
};

}  // namespace longreach
