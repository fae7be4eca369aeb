#pragma once
// Plausibility check of the force sensor. Each sample is checked before it is used. A fault is a reading that
// no contact can cause. T is the time since the previous sample, and v is the speed of the tool. The noise σ,
// the resolution r and the range R are configured. G is force_guard_n, k_max is guard_stiffness_n_per_m, and
// m is the mass of the tool:
//
//   kind       checked                       a fault if                                         reported after
//   nonsense   each sample                   a number is not finite                             1 sample
//   range      each channel of a sample      beyond R + r; R = 0: beyond 1e5 N + 2 m (|g| + a)  1 sample
//   jump       compensated force, relative   more than G + 10 σ + 2 r + u + T (k_hard v +       1 sample
//              to the previous one           k_max 0.1 m/s), k_hard = 1e7 N/m: steel on steel
//   saturated  each channel                  continuously at its range                          50 ms
//   frozen     all channels, σ > r/2         constant to the last digit, not zero, while the    50 ms and 1 mm
//                                            tool moves
//
// u is the effect of an uncertain acceleration of the tool (tool_load.hpp). A force may vanish at once, for
// example at a latch or an edge. A sensor that freezes in free space or at rest, a bias, a drift, and a scale
// error are not detected. The retreat distance limits their effect on the robot (retreat_budget.hpp).

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
    Vector3 p_WE = Vector3::Zero();  // measured position of the tool, m
    double speed_m_per_s = 0.0;
    double elapsed_s = 0.0;  // time since the previous sample
  };

  /// Checks a reading, which is expressed in the axes of the tool. Returns true if it is plausible.
  bool read(const Wrench& reading, const Motion& motion);
  /// Checks the force after compensation, in W; `uncertainty_n` is u. Returns true if it is plausible.
  bool felt(const Vector3& force_n, const Motion& motion, double uncertainty_n);

 private:
  [[nodiscard]] bool in_range(const Wrench& reading) const;
  [[nodiscard]] bool saturates(const Wrench& reading) const;
  [[nodiscard]] bool repeats(const Wrench& reading) const;
  [[nodiscard]] double leap_max_n(const Motion& motion) const;

  SensingConfig sensing_;
  CommandConfig command_;
  std::optional<Wrench> read_{};   // last reading
  std::optional<Vector3> felt_{};  // last force, N
  double saturated_s_ = 0.0;
  double same_s_ = 0.0, same_m_ = 0.0;
  Vector3 p_WE_ = Vector3::Zero();
};

}  // namespace longreach
