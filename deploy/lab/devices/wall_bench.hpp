#pragma once
// A virtual wall below the handle of the simulated DELTA device, pressed by a constant force and held by a
// hand: tests stability and generated energy. Along the vertical through home; the surface of the wall is at
// home. The device has all properties of its configuration.

#include "deploy/lab/devices/sampled_wall.hpp"
#include "master/config/device_config.hpp"

namespace longreach {

struct WallCase {
  DeviceConfig device{};
  Grip grip = Grip::kLight;
  double period_s = 0.001;
  double wall_n_s_per_m = 0.0;
};

/// The device without Coulomb friction, encoder steps, motor lag and weight, as in the exact model.
DeviceConfig ideal_device(DeviceConfig device);
/// With the viscous friction that gives this damping at home along the vertical.
DeviceConfig with_damping(DeviceConfig device, double vertical_n_s_per_m);

/// The linear model of the same case.
SampledWall model_of(const WallCase& c);

/// Returns whether a small disturbance decays (ideal device).
bool decays(const WallCase& c, double stiffness_n_per_m);
/// Maximum stiffness at which it decays, by bisection to 1 %, N/m.
double simulated_limit_n_per_m(const WallCase& c);

/// Root mean square of the motion twelve seconds after a tap of `tap_m`, m.
double residual_m(const WallCase& c, double stiffness_n_per_m, double tap_m);

/// Energy per cycle, J, that a hand puts into the handle by moving it back and forth inside the wall (20 Hz,
/// stiff coupling); negative: the device generates energy.
double cycle_energy_j(const WallCase& c, double stiffness_n_per_m);

}  // namespace longreach
