#pragma once
// The robot's part of `longreach-lab solve`: one request, one answer. Throws BadRequest or ConfigError.
// Joint limits do not count here: the questions are about geometry.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_robot_fk(const solve_json::Json& request);
solve_json::Json solve_robot_ik(const solve_json::Json& request);

}  // namespace longreach
