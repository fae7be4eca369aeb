#include "deploy/lab/solve/solve.hpp"

#include <istream>
#include <ostream>

#include "common/config/config.hpp"
#include "common/core/geometry_error.hpp"
#include "deploy/lab/solve/solve_delta.hpp"
#include "deploy/lab/solve/solve_impact.hpp"
#include "deploy/lab/solve/solve_robot.hpp"
#include "deploy/lab/solve/solve_spherical.hpp"

namespace longreach {
namespace {

using solve_json::Json;

struct Kind {
  std::string_view name;
  Json (*answer)(const Json& request);
};

constexpr Kind kKinds[] = {{"delta-ik", solve_delta_ik},           {"delta-fk", solve_delta_fk},
                           {"delta-statics", solve_delta_statics}, {"spherical-ik", solve_spherical_ik},
                           {"spherical-fk", solve_spherical_fk},   {"robot-fk", solve_robot_fk},
                           {"robot-ik", solve_robot_ik},           {"impact", solve_impact}};

}  // namespace

std::vector<std::string> solve_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

int solve(std::string_view kind, std::istream& in, std::ostream& out) {
  const Kind* chosen = nullptr;
  for (const Kind& k : kKinds) {
    if (k.name == kind) chosen = &k;
  }
  if (!chosen) return 2;
  bool bad = false;
  std::string line;
  while (std::getline(in, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Json answer;
    try {
      answer = chosen->answer(solve_json::parse(line));
    } catch (const solve_json::BadRequest& e) {
      answer = {{"error", e.what()}};
    } catch (const GeometryError& e) {
      answer = {{"error", e.what()}};
    } catch (const ConfigError& e) {
      answer = {{"error", e.what()}};
    }
    bad |= answer.contains("error");
    // Flushes every line, because a program may wait for it at the other end of a pipe. Invalid UTF-8 is
    // replaced.
    out << answer.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
  }
  return bad ? 1 : 0;
}

}  // namespace longreach
