#pragma once
// Simulates a faulty force sensor by changing the wrench that the sensor of a robot measured. With the force
// f, the direction u (both in the tool frame), the amount a and the time t since the start of the fault, the
// outputs are:
//   bias f + a u    drift f + a t u    stuck a u    frozen f at t = 0    spike a u in one sample every period
//   saturation each channel within ±a    sign -f    frame f turned by a about u
//   axes channel x outputs y, y outputs z, z outputs x    scale a f
// The faults sign, frame, axes and scale also affect the moment; the others do not.

#include <cstdint>
#include <optional>
#include <string_view>

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

enum class SensorFaultKind : std::uint8_t {
  kNone,
  kBias,
  kDrift,
  kStuck,
  kFrozen,
  kSpike,
  kSaturation,
  kSign,
  kFrame,
  kAxes,
  kScale,
  kCount
};

std::string_view name(SensorFaultKind sensor_fault);

struct SensorFault {
  SensorFaultKind sensor_fault = SensorFaultKind::kNone;
  double amount = 0.0;                   // N, N/s, rad or a factor; any value is allowed, even NaN
  Vector3 direction = Vector3::UnitX();  // unit vector in the tool frame
  double period_s = 0.0;                 // period of the spikes; 0: a single spike
};

class FaultySensor {
 public:
  explicit FaultySensor(const RobotConfig& robot) : kinematics_(robot) {}

  /// Sets the fault that applies from the next sample on; kNone ends the fault.
  void sensor_fault(const SensorFault& sensor_fault);
  /// Applies the fault to the state that the robot reported at `now`. The times of successive samples must
  /// increase.
  void apply(Time now, RobotState& robot);

  [[nodiscard]] const SensorFault& sensor_fault() const { return sensor_fault_; }

 private:
  [[nodiscard]] Wrench reported(const Wrench& felt, double t_s);
  [[nodiscard]] bool spikes(double t_s);

  Kinematics kinematics_;
  SensorFault sensor_fault_{};
  std::optional<Time> begun_{};
  Vector3 frozen_n_ = Vector3::Zero();
  std::uint64_t spikes_ = 0;
};

}  // namespace longreach
