#pragma once
// Evaluates what a force sensor reported while the user pushed the tool along the axes of the robot's base
// and turned it about them. The sensor must report the force of the environment on the tool, in the axes of
// the tool E: f_E = R_WEᵀ f_W. Pure functions.

#include <array>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "deploy/cli/finding.hpp"

namespace longreach {

/// A push along axis i of the base W, or a turn about that axis.
struct Push {
  Matrix3 R_WE = Matrix3::Identity();
  /// Difference from the value reported without contact, N or N m; zero if no force was measured.
  Vector3 reported = Vector3::Zero();
};

/// The three pushes of one sensor: `what` is "force" or "moment", `unit` is N or N m.
struct PushedSensor {
  const char* what = "force";
  const char* unit = "N";
  Vector3 rest = Vector3::Zero();  // reported value without contact
  double rest_max = 2.0;           // maximum permitted magnitude of `rest`
  std::array<Push, 3> push{};
};

std::vector<Finding> judge_pushes(const PushedSensor& sensor);

}  // namespace longreach
