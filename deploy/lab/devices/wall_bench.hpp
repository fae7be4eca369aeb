#pragma once
// A virtual wall below the handle of the simulated DELTA device, for testing stability and energy generation.
// The handle moves along the vertical through home, and the surface of the wall is at home. A hand holds the
// handle, and a constant force presses it into the wall. The device has all the properties given in its
// configuration.

#include "deploy/lab/devices/sampled_wall.hpp"
#include "schema/config_master.hpp"

namespace longreach {

struct WallCase {
  DeviceConfig device{};
  Grip grip = Grip::kLight;
  double period_s = 0.001;
  double wall_n_s_per_m = 0.0;
};

/// Returns the device without Coulomb friction, encoder quantization, motor lag and weight, as in the linear
/// model.
DeviceConfig ideal_device(DeviceConfig device);
/// Returns the device with the viscous friction that gives this damping for vertical motion at home.
DeviceConfig with_damping(DeviceConfig device, double vertical_n_s_per_m);

/// Returns the linear model of the same case.
SampledWall model_of(const WallCase& c);

/// Returns whether a small disturbance decays. The device must be ideal (see ideal_device()).
bool decays(const WallCase& c, double stiffness_n_per_m);
/// Maximum stiffness at which a small disturbance decays, found by bisection to 1 %, N/m.
double simulated_limit_n_per_m(const WallCase& c);

/// RMS motion of the handle twelve seconds after a tap of `tap_m`, m.
double residual_m(const WallCase& c, double stiffness_n_per_m, double tap_m);

/// Energy per cycle, J, that a hand puts into the handle by moving it back and forth inside the wall (20 Hz,
/// stiff coupling). If this energy is negative, the device generates energy.
double cycle_energy_j(const WallCase& c, double stiffness_n_per_m);

}  // namespace longreach
