#pragma once
// `longreach-lab solve KIND`: computes impacts, and the kinematics and statics of devices and robots of any
// geometry. Each input line is a request, a JSON object; each output line is the result, or {"error": "..."}
// if the request is invalid. Angles are in radians unless a key ends with _deg.
//
//   delta-ik        geometry, p                 -> {"theta": [[two roots] per leg]}
//   delta-fk        geometry, theta             -> {"solutions": [[x, y, z], ...]}
//   delta-statics   geometry, p or theta, masses, gravity -> {"tau": [3]}    motor torques that hold the device
//   spherical-ik    angles or axes, R           -> {"theta": [[two roots] per leg]}
//   spherical-fk    angles or axes, theta       -> {"solutions": [R, ...]}
//                   with the key near           -> {"R": 3x3, "iterations": n, "status": "FOUND"}
//
//   robot-fk        robot or dh, convention, q  -> {"X": 4x4, "J": 6x6}      angular rows of J first
//   robot-ik        robot or dh, convention, X, near -> {"status", "solutions": [[6], ...], "nearest": [6],
//                   "position_error", "rotation_error", "kind"}              m, rad; slave/kinematics/inverse.hpp
//
//   impact          m, k, lambda, n, v, dt, integrator -> {"restitution", "penetration_max", "contact_time",
//                   "energy_error", "evaluations"}           SI; a free impact at speed v, free_impact.hpp
//
// integrator: "discrete_gradient" (default), "explicit_euler", "semi_implicit_euler" or "rk4". The default of
// dt is at most 1/64 of the contact time. robot: name of a file in deploy/robots. dh: six objects {"a",
// "alpha", "d", "theta"}. convention: "standard" (default) or "modified". Joint limits are ignored.
//
// The list of solutions is empty if the pose is not reachable. delta-statics uses the first working mode if
// the position p is given, and the working assembly mode if the angles theta are given (delta_kinematics.hpp).

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

/// Returns the names of the kinds.
std::vector<std::string> solve_kinds();

/// Solves every request in `in`. Returns 0 on success, 1 if a request was invalid, or 2, without reading any
/// input, if the kind is unknown.
int solve(std::string_view kind, std::istream& in, std::ostream& out);

}  // namespace longreach
