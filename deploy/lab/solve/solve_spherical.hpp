#pragma once
// `longreach-lab solve` for the 3-RRR device. Each function maps a request to its result. Throws BadRequest
// or GeometryError.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_spherical_ik(const solve_json::Json& request);
solve_json::Json solve_spherical_fk(const solve_json::Json& request);

}  // namespace longreach
