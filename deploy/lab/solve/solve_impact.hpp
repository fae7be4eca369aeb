#pragma once
// The impact's part of `longreach-lab solve`: one request, one answer. Throws BadRequest.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_impact(const solve_json::Json& request);

}  // namespace longreach
