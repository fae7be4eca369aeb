#pragma once
// The part of a contact force that is not rendered because the energy for it is lacking.

#include <algorithm>

#include "master/rendering/renderer.hpp"

namespace longreach {

/// Returns the force, N, that the depth of the handle demands beyond the rendered force of the foremost surface; 0 if the
/// tool does not press on it, the force is at its limit or no hand is on the handle.
inline double withheld_force(const HandPort& port, const HandleState& handle) {
  const ContactAxis& surface = port.contact.foremost();
  if (!surface.pressed || surface.spring.yielding() || !handle.held) return 0.0;
  const double full_n = surface.spring.stiffness_n_per_m() * (surface.s(handle.p_MH) - surface.surface);
  return port.guard.gain() * std::max(0.0, full_n - surface.force);
}

}  // namespace longreach
