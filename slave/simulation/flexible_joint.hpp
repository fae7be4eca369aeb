#pragma once
// A link connected to its servo by a spring, a damper and dry friction:
//   M q̈ = K (θ - q) + D (θ̇ - q̇) + τ - friction sgn(q̇)
// The solution is exact over a step in which the servo moves uniformly and τ is constant. A link that stops
// within the step stays at rest. M is constant, and the joints are not coupled.

#include "schema/config_slave.hpp"

namespace longreach {

struct LinkState {
  double rad = 0.0, rad_per_s = 0.0;
};

struct ServoMotion {
  double rad = 0.0;        // position before the step
  double rad_per_s = 0.0;  // speed in the step
};

/// Returns the state of the link after `dt` >= 0 s. The stiffness of `joint` must be > 0; `torque_nm` is the
/// external torque.
LinkState swing(const JointConfig& joint, const LinkState& link, const ServoMotion& servo, double torque_nm,
                double dt);

}  // namespace longreach
