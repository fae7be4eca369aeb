#pragma once
// One tick's way towards a solution that is far off in the joints and near for the tool: where joints can
// move without the tool, at a singular pose or next to one.
//   min |J Δq - e|² + μ |Δq - pull|²,  q_min <= q + Δq <= q_max
// e: what the tool has to go (angular rows times the reach), pull: towards that solution. Directions that
// move the tool by much less than √μ a radian follow the pull, all others the tool: a damped step whose
// damping leads somewhere, and that vanishes at the solution. Joints that would pass a limit stay there, the
// others make up for them.

#include "slave/robot/kinematics.hpp"

namespace longreach {

struct SelfMotion {
  JointVector joint_rad;  // present joints, within the limits
  JointVector min_rad, max_rad;
  JointVector pull_rad;
  double lost = 0.0;  // √μ over the reach, > 0
};

/// The joints after the tick, within the limits.
JointVector self_motion_step(const Kinematics& arm, const SelfMotion& from, const Rigid& X_WE_goal);

}  // namespace longreach
