#pragma once
// `longreach-lab solve KIND`: kinematics and statics of the haptic devices for anybody's geometry. One JSON
// object a line in, one a line out; {"error": "..."} for a line that cannot be answered. Radians unless a key
// says _deg.
//
//   delta-ik        geometry, p                 -> {"theta": [[two roots] a leg]}
//   delta-fk        geometry, theta             -> {"solutions": [[x, y, z], ...]}
//   delta-statics   geometry, p or theta, masses, gravity -> {"tau": [3]}    torques that hold the device
//   still spherical-ik    angles or axes, R           -> {"theta": [[two roots] a leg]} spherical-fk angles
//   or axes, theta       -> {"solutions": [R, ...]}
//                   and near                    -> {"R": 3x3, "iterations": n, "status": "FOUND"}
//
// Unreachable: an empty list. In delta-statics a position takes the first working mode, angles the working
// assembly (delta_kinematics.hpp).

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

/// Names of the kinds.
std::vector<std::string> solve_kinds();

/// Answers every line of `in`. Returns 0; 1 after a bad line; 2 for an unknown kind, with nothing read.
int solve(std::string_view kind, std::istream& in, std::ostream& out);

}  // namespace longreach
