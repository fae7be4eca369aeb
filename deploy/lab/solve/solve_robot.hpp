#pragma once
// `longreach-lab solve` for robots: one request, one answer. Throws BadRequest or ConfigError. Joint limits
// are ignored, because the requests are about geometry.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_robot_fk(const solve_json::Json& request);
solve_json::Json solve_robot_ik(const solve_json::Json& request);

}  // namespace longreach
