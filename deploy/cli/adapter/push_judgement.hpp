#pragma once
// Evaluates the reports of a force sensor while the user pushed the tool along the axes of the robot's base
// and turned it about them. Pure. The report must be the force by the environment on the tool, along the axes
// of the tool E:  f_E = R_WEᵀ f_W.

#include <array>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "deploy/cli/finding.hpp"

namespace longreach {

/// A push along, or a rotation about, the axis i of the base W.
struct Push {
  Matrix3 R_WE = Matrix3::Identity();
  /// difference from the report at rest, N or N m; zero: no force was measured
  Vector3 reported = Vector3::Zero();
};

/// `what`: "force" or "moment"; `unit`: N or N m.
struct PushedSensor {
  const char* what = "force";
  const char* unit = "N";
  Vector3 rest = Vector3::Zero();  // report without contact
  double rest_max = 2.0;           // maximum offset
  std::array<Push, 3> push{};
};

std::vector<Finding> judge_pushes(const PushedSensor& sensor);

}  // namespace longreach
