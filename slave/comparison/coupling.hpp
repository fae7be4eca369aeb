#pragma once
// The closed set of comparison laws at the slave.

#include <variant>

#include "slave/comparison/follow_coupling.hpp"
#include "slave/comparison/passivity_coupling.hpp"
#include "slave/comparison/spring_coupling.hpp"
#include "slave/comparison/tank_coupling.hpp"
#include "slave/comparison/wave_coupling.hpp"

namespace longreach {

using Coupling = std::variant<FollowCoupling, SpringCoupling, WaveCoupling, PassivityCoupling, TankCoupling>;

inline CouplingOutput step(Coupling& coupling, const CouplingInput& in, double dt_s) {
  return std::visit([&](auto& c) { return c.step(in, dt_s); }, coupling);
}

}  // namespace longreach
