#pragma once
// A virtual wall below the handle of the simulated DELTA device, pressed by a constant force and held by a
// hand: is it calm, and does it give energy away? Along the vertical through home; the wall's surface is at
// home. The device is the real one, with everything that its configuration says.

#include "deploy/lab/devices/sampled_wall.hpp"
#include "master/config/device_config.hpp"

namespace longreach {

struct WallCase {
  DeviceConfig device{};
  Grip grip = Grip::kLight;
  double period_s = 0.001;
  double wall_n_s_per_m = 0.0;
};

/// The device without Coulomb friction, encoder steps, motor lag and weight: what the exact model describes.
DeviceConfig ideal_device(DeviceConfig device);
/// With the viscous friction that makes this damping at home along the vertical.
DeviceConfig with_damping(DeviceConfig device, double vertical_n_s_per_m);

/// The linear model of the same case.
SampledWall model_of(const WallCase& c);

/// Whether a small disturbance dies away (ideal device).
bool decays(const WallCase& c, double stiffness_n_per_m);
/// Largest stiffness at which it does, by bisection to 1 %, N/m.
double simulated_limit_n_per_m(const WallCase& c);

/// What remains of the motion twelve seconds after a tap of `tap_m`, root mean square, m.
double residual_m(const WallCase& c, double stiffness_n_per_m, double tap_m);

/// Energy that a hand which moves the handle to and fro inside the wall (20 Hz, stiff coupling) puts into it
/// a cycle, J; negative: the device gives energy away.
double cycle_energy_j(const WallCase& c, double stiffness_n_per_m);

}  // namespace longreach
