#pragma once
// A link connected to its servo by a spring, with a damper and dry friction:
//   M q̈ = K (θ - q) + D (θ̇ - q̇) + τ - friction sgn(q̇)
// Exact over a step in which the servo moves uniformly and τ is constant; a link that stops within the step
// stays at rest. M is constant: joints are not coupled.

#include "slave/config/robot_config.hpp"

namespace longreach {

struct LinkState {
  double rad = 0.0, rad_per_s = 0.0;
};

struct ServoMotion {
  double rad = 0.0;        // before the step
  double rad_per_s = 0.0;  // in the step
};

/// `joint`: stiffness > 0. `torque_nm` is external. dt >= 0, s.
LinkState swing(const JointConfig& joint, const LinkState& link, const ServoMotion& servo, double torque_nm,
                double dt);

}  // namespace longreach
