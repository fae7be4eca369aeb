#pragma once
// The properties of the configured device that limit the rendering.

#include "master/config/master_config.hpp"
#include "master/rendering/renderer.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {

/// Throws GeometryError, which names the parameter, for an impossible device.
inline RenderedDevice rendered_device(const MasterConfig& c) {
  const double period_s = 1.0 / c.loop.rate_hz;
  DeviceFigures device = device_figures(c.device, period_s);
  if (!c.device_adapter.address.empty()) device.delay_s += period_s;  // an adapter adds a delay of one sample
  return {.mass_kg = device.mass_kg,
          .damping_n_s_per_m = device.damping_n_s_per_m,
          .inertia_kg_m2 = device.inertia_kg_m2,
          .damping_nm_s_per_rad = device.damping_nm_s_per_rad,
          .period_s = period_s,
          .delay_s = device.delay_s,
          .cell = device.cell,
          .turns = c.device.turns};
}

}  // namespace longreach
