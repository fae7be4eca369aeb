#pragma once
// A simulated six-axis force/torque sensor, which measures the wrench w that acts on it. Each of the six
// channels is computed in the frame of the sensor; ξ is normally distributed with standard deviation 1:
//   y += (1 - exp(-2π f dt)) (w - y)                        bandwidth f
//   b += drift √dt ξ                                        bias, a random walk from its initial value
//   reading = clamp(round((y + b + noise ξ)/res) res)       resolution, range
// Crosstalk, hysteresis and temperature effects are modelled only as part of the bias.

#include "common/core/random.hpp"
#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

class ForceSensor {
 public:
  ForceSensor(const SensingConfig& config, Random random);

  /// Returns the reading `dt` >= 0 s after the previous one. If the wrench is not finite, the previous wrench
  /// is used.
  Wrench step(const Wrench& wrench, double dt);

  [[nodiscard]] const Wrench& bias() const { return bias_; }

 private:
  struct Channel {
    double noise, drift, resolution, range;
  };
  [[nodiscard]] Vector3 read(const Vector3& felt, const Channel& channel);

  Channel force_, moment_;
  double bandwidth_hz_;
  Random random_;
  Wrench bias_{};
  Wrench felt_{};
  bool begun_ = false;
};

}  // namespace longreach
