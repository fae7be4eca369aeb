#include "deploy/lab/robot/lying_sensor.hpp"

#include <array>

namespace longreach {
namespace {

Vector3 turned_axes(const Vector3& v) { return {v.y(), v.z(), v.x()}; }

}  // namespace

std::string_view name(Lie lie) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(Lie::kCount)> kNames{
      "none", "bias", "drift", "stuck", "frozen", "spike", "saturation", "sign", "frame", "axes", "scale"};
  return kNames[static_cast<std::size_t>(lie)];
}

void LyingSensor::lie(const SensorLie& lie) {
  lie_ = lie;
  begun_.reset();
  spikes_ = 0;
}

void LyingSensor::tell(Time now, RobotState& robot) {
  const Quaternion q_WE = kinematics_.forward(robot.joint_rad).q;
  const Quaternion q_EW = q_WE.conjugate();
  const Wrench felt{q_EW * robot.F_F_W.moment, q_EW * robot.F_F_W.force};
  if (!begun_) {
    begun_ = now;
    frozen_n_ = felt.force;
  }
  if (lie_.lie == Lie::kNone) return;
  const Wrench says = told(felt, to_seconds(now - *begun_));
  robot.F_F_W = {q_WE * says.moment, q_WE * says.force};
}

Wrench LyingSensor::told(const Wrench& felt, double t_s) {
  const double a = lie_.amount;
  const Vector3 by = a * lie_.direction;
  switch (lie_.lie) {
    case Lie::kBias:
      return {felt.moment, felt.force + by};
    case Lie::kDrift:
      return {felt.moment, felt.force + t_s * by};
    case Lie::kStuck:
      return {felt.moment, by};
    case Lie::kFrozen:
      return {felt.moment, frozen_n_};
    case Lie::kSpike:
      return {felt.moment, spikes(t_s) ? by : felt.force};
    case Lie::kSaturation:
      return {felt.moment, felt.force.cwiseMax(-a).cwiseMin(a)};
    case Lie::kSign:
      return {-felt.moment, -felt.force};
    case Lie::kFrame: {
      const Quaternion turn = exp_rotation(by);
      return {turn * felt.moment, turn * felt.force};
    }
    case Lie::kAxes:
      return {turned_axes(felt.moment), turned_axes(felt.force)};
    case Lie::kScale:
      return {a * felt.moment, a * felt.force};
    case Lie::kNone:
    case Lie::kCount:
      break;
  }
  return felt;
}

// True in the first sample of each period.
bool LyingSensor::spikes(double t_s) {
  if (t_s < static_cast<double>(spikes_) * lie_.period_s) return false;
  if (spikes_ > 0 && !(lie_.period_s > 0.0)) return false;
  ++spikes_;
  return true;
}

}  // namespace longreach
