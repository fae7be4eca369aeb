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
//   saturated  each channel of the force     continuously at its range                          50 ms
//   frozen     the three channels of force   constant to the last digit, also at zero, after    50 ms and 1 mm
//              or of moment, σ > r/2         one has varied, while the tool moves
//              (in the axes of the tool, where a sensor repeats, or in W, where an adapter repeats)
//   stuck      each channel, σ > r/2         constant to the last digit after it has varied     0.25 s
//
// A sensor whose force, or whose moment if it is measured, has had a single value since the start is constant():
// no engagement may start. For σ <= r/2, a reading may repeat, and the last two rows and constant() do not
// apply. A stall of the robot's adapter of up to 0.1 s repeats the samples and is not a fault.
//
// u is the effect of an uncertain acceleration of the tool (tool_load.hpp). A force may vanish at once, for
// example at a latch or an edge. A bias, a drift, a scale error, and a channel that has never varied beside
// channels that do are not detected. The retreat distance limits their effect on the robot
// (retreat_budget.hpp).

#include <array>
#include <optional>

#include "common/link/hold_cause.hpp"
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
    Quaternion q_WE = Quaternion::Identity();
  };

  /// Checks a reading, which is expressed in the axes of the tool. Returns true if it is plausible.
  bool read(const Wrench& reading, const Motion& motion);
  /// Checks the force after compensation, in W; `uncertainty_n` is u. Returns true if it is plausible.
  bool felt(const Vector3& force_n, const Motion& motion, double uncertainty_n);
  /// Returns kSensorConstant if the force has had a single value since the start, with the value 0, or the
  /// moment, with the value 1; otherwise no reason. In the first 0.25 s, the reason is kSensorZeroing.
  [[nodiscard]] Reason constant() const;

 private:
  /// Repetition of the three channels of the force or of the moment.
  class Repetition {
   public:
    /// Processes a reading in the axes of the tool, and the displacement of the tool since the previous one.
    void step(const Vector3& reading, const Motion& motion, double moved_m);
    /// Returns whether the channels are frozen or one of them is stuck.
    [[nodiscard]] bool faulty() const;
    /// Returns whether a channel has had a second value.
    [[nodiscard]] bool varied() const { return varied_[0] || varied_[1] || varied_[2]; }
    [[nodiscard]] double seen_s() const { return seen_s_; }

   private:
    std::optional<Vector3> before_{};
    Vector3 before_W_ = Vector3::Zero();
    std::array<bool, 3> varied_{};
    std::array<double, 3> stuck_s_{};
    double same_s_ = 0.0, same_m_ = 0.0;  // all channels repeat
    double seen_s_ = 0.0;                 // time since the first reading
  };

  [[nodiscard]] bool in_range(const Wrench& reading) const;
  [[nodiscard]] bool saturates(const Wrench& reading) const;
  [[nodiscard]] bool noisy_force() const;
  [[nodiscard]] bool noisy_moment() const;
  [[nodiscard]] double leap_max_n(const Motion& motion) const;

  SensingConfig sensing_;
  CommandConfig command_;
  Repetition force_, moment_;
  std::optional<Vector3> felt_{};  // last force, N
  double saturated_s_ = 0.0;
  std::optional<Vector3> p_WE_{};  // position of the tool at the last reading
};

}  // namespace longreach
