#pragma once
// `longreach-lab solve` for robots. Each function maps a request to its result. Joint limits are ignored,
// because the requests concern only the geometry. Throws BadRequest or ConfigError.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_robot_fk(const solve_json::Json& request);
solve_json::Json solve_robot_ik(const solve_json::Json& request);

}  // namespace longreach
