#pragma once
// `longreach-lab solve` for impacts: one request, one answer. Throws BadRequest.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_impact(const solve_json::Json& request);

}  // namespace longreach
