#pragma once
// Combines the comparison laws at the slave in one variant type. They are the textbook couplings that the
// laboratory compares with the product.

#include <variant>

#include "deploy/lab/comparison/follow_coupling.hpp"
#include "deploy/lab/comparison/passivity_coupling.hpp"
#include "deploy/lab/comparison/spring_coupling.hpp"
#include "deploy/lab/comparison/tank_coupling.hpp"
#include "deploy/lab/comparison/wave_coupling.hpp"

namespace longreach {

using Coupling = std::variant<FollowCoupling, SpringCoupling, WaveCoupling, PassivityCoupling, TankCoupling>;

/// Steps the law that `coupling` holds; `dt_s` > 0.
inline CouplingOutput step(Coupling& coupling, const CouplingInput& in, double dt_s) {
  return std::visit([&](auto& c) { return c.step(in, dt_s); }, coupling);
}

}  // namespace longreach
