#include "slave/simulation/force_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace longreach {

ForceSensor::ForceSensor(const SensingConfig& config, Random random)
    : force_{config.force_noise_n, config.force_drift_n, config.force_resolution_n, config.force_range_n},
      moment_{config.moment_noise_nm, config.moment_drift_nm, config.moment_resolution_nm,
              config.moment_range_nm},
      bandwidth_hz_(config.bandwidth_hz),
      random_(random),
      bias_{Vector3::Constant(config.moment_bias_nm), Vector3::Constant(config.force_bias_n)} {}

Wrench ForceSensor::step(const Wrench& wrench, double dt) {
  if (wrench.force.allFinite() && wrench.moment.allFinite()) {
    const bool at_once = !begun_ || !(bandwidth_hz_ > 0.0);
    const double share = at_once ? 1.0 : -std::expm1(-2.0 * std::numbers::pi * bandwidth_hz_ * dt);
    felt_.force += share * (wrench.force - felt_.force);
    felt_.moment += share * (wrench.moment - felt_.moment);
    begun_ = true;
  }
  for (int i = 0; i < 3; ++i) {
    if (force_.drift > 0.0) bias_.force[i] += force_.drift * std::sqrt(dt) * random_.normal();
    if (moment_.drift > 0.0) bias_.moment[i] += moment_.drift * std::sqrt(dt) * random_.normal();
  }
  // Forces first: the order of the noise.
  const Vector3 force = read(felt_.force + bias_.force, force_);
  return {read(felt_.moment + bias_.moment, moment_), force};
}

Vector3 ForceSensor::read(const Vector3& felt, const Channel& channel) {
  Vector3 reported;
  for (int i = 0; i < 3; ++i) {
    double value = felt[i] + channel.noise * random_.normal();
    if (channel.resolution > 0.0) value = std::round(value / channel.resolution) * channel.resolution;
    if (channel.range > 0.0) value = std::clamp(value, -channel.range, channel.range);
    reported[i] = value;
  }
  return reported;
}

}  // namespace longreach
