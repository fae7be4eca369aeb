#pragma once
// `longreach-lab solve` for impacts. Maps a request to its result. Throws BadRequest.

#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

solve_json::Json solve_impact(const solve_json::Json& request);

}  // namespace longreach
