#pragma once
// Text about the boundary at which the robot stands: the joint at its limit or the end of the reach, and the direction
// in which the goal is beyond it; and about the limit that a load sets. Pure.

#include <string>

#include "schema/state_link.hpp"

namespace longreach {

/// Returns, for example, "joint 5 is at its upper limit, towards +x" or "end of the reach, about -z"; an empty
/// string if neither stops the tool. The direction is the axis of W that is nearest to the displacement (above 1 mm)
/// or else to the rotation from the tool to its goal.
std::string boundary_in_words(const Clamps& clamps, const Pose& X_WE, const Pose& X_WE_goal);

/// Returns, for example, "acceleration limited to 0.5 m/s² and 0.125 rad/s²: load in the gripper". A limit of 0 is not in
/// force and is not named; an empty string if both are 0.
std::string load_limit_in_words(double acceleration_m_per_s2, double acceleration_rad_per_s2);

}  // namespace longreach
