#include "deploy/lab/robot/faulty_sensor.hpp"

#include <array>

namespace longreach {
namespace {

Vector3 turned_axes(const Vector3& v) { return {v.y(), v.z(), v.x()}; }

}  // namespace

std::string_view name(SensorFaultKind sensor_fault) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(SensorFaultKind::kCount)> kNames{
      "none", "bias", "drift", "stuck", "frozen", "spike", "saturation", "sign", "frame", "axes", "scale"};
  return kNames[static_cast<std::size_t>(sensor_fault)];
}

void FaultySensor::sensor_fault(const SensorFault& sensor_fault) {
  sensor_fault_ = sensor_fault;
  begun_.reset();
  spikes_ = 0;
}

void FaultySensor::apply(Time now, RobotState& robot) {
  const Quaternion q_WE = kinematics_.forward(robot.joint_rad).q;
  const Quaternion q_EW = q_WE.conjugate();
  const Wrench felt{q_EW * robot.F_F_W.moment, q_EW * robot.F_F_W.force};
  if (!begun_) {
    begun_ = now;
    frozen_n_ = felt.force;
  }
  if (sensor_fault_.sensor_fault == SensorFaultKind::kNone) return;
  const Wrench says = reported(felt, to_seconds(now - *begun_));
  robot.F_F_W = {q_WE * says.moment, q_WE * says.force};
}

Wrench FaultySensor::reported(const Wrench& felt, double t_s) {
  const double a = sensor_fault_.amount;
  const Vector3 by = a * sensor_fault_.direction;
  switch (sensor_fault_.sensor_fault) {
    case SensorFaultKind::kBias:
      return {felt.moment, felt.force + by};
    case SensorFaultKind::kDrift:
      return {felt.moment, felt.force + t_s * by};
    case SensorFaultKind::kStuck:
      return {felt.moment, by};
    case SensorFaultKind::kFrozen:
      return {felt.moment, frozen_n_};
    case SensorFaultKind::kSpike:
      return {felt.moment, spikes(t_s) ? by : felt.force};
    case SensorFaultKind::kSaturation:
      return {felt.moment, felt.force.cwiseMax(-a).cwiseMin(a)};
    case SensorFaultKind::kSign:
      return {-felt.moment, -felt.force};
    case SensorFaultKind::kFrame: {
      const Quaternion turn = exp_rotation(by);
      return {turn * felt.moment, turn * felt.force};
    }
    case SensorFaultKind::kAxes:
      return {turned_axes(felt.moment), turned_axes(felt.force)};
    case SensorFaultKind::kScale:
      return {a * felt.moment, a * felt.force};
    case SensorFaultKind::kNone:
    case SensorFaultKind::kCount:
      break;
  }
  return felt;
}

// True in the first sample of each period.
bool FaultySensor::spikes(double t_s) {
  if (t_s < static_cast<double>(spikes_) * sensor_fault_.period_s) return false;
  if (spikes_ > 0 && !(sensor_fault_.period_s > 0.0)) return false;
  ++spikes_;
  return true;
}

}  // namespace longreach
