#pragma once
// `longreach-lab solve KIND`: kinematics and statics of devices and robots with any geometry, and impacts.
// One JSON object per line as input, one per line as output; {"error": "..."} for a line that cannot be
// answered. Radians unless a key ends with _deg.
//
//   delta-ik        geometry, p                 -> {"theta": [[two roots] a leg]}
//   delta-fk        geometry, theta             -> {"solutions": [[x, y, z], ...]}
//   delta-statics   geometry, p or theta, masses, gravity -> {"tau": [3]}    torques that hold the device
//   spherical-ik    angles or axes, R           -> {"theta": [[two roots] a leg]}
//   spherical-fk    angles or axes, theta       -> {"solutions": [R, ...]}
//                   and near                    -> {"R": 3x3, "iterations": n, "status": "FOUND"}
//
//   robot-fk        robot or dh, convention, q  -> {"X": 4x4, "J": 6x6}      angular rows of J first
//   robot-ik        robot or dh, convention, X, near -> {"status", "solutions": [[6], ...], "nearest": [6],
//                   "position_error", "rotation_error", "kind"}              m, rad; slave/kinematics/inverse.hpp
//
//   impact          m, k, lambda, n, v, dt, integrator -> {"restitution", "penetration_max", "contact_time",
//                   "energy_error", "evaluations"}           SI; a free impact at speed v, free_impact.hpp
//
// integrator: "discrete_gradient" (the default), "explicit_euler", "semi_implicit_euler" or "rk4". The
// default of dt is at most a 64th of the contact time. robot: name of a file in deploy/robots; dh: six of
// {"a", "alpha", "d", "theta"}; convention "standard" (the default) or "modified". Joint limits are ignored.
//
// Unreachable: an empty list. In delta-statics a position uses the first working mode, angles the working
// assembly (delta_kinematics.hpp).

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

/// Names of the kinds.
std::vector<std::string> solve_kinds();

/// Answers every line of `in`. Returns 0; 1 after an invalid line; 2 for an unknown kind, without reading.
int solve(std::string_view kind, std::istream& in, std::ostream& out);

}  // namespace longreach
