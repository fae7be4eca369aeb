#pragma once
// What a force sensor told while somebody pushed the tool along the axes of the robot's base and turned it
// about them, and what is wrong with that. Pure. Told has to be, of the environment on the tool, along the
// axes of the tool E:  f_E = R_WEᵀ f_W.

#include <array>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "deploy/cli/finding.hpp"

namespace longreach {

/// A push along, or a turn about, the axis i of the base W.
struct Push {
  Matrix3 R_WE = Matrix3::Identity();
  Vector3 reported = Vector3::Zero();  // beyond what was told at rest, N or N m; zero: nothing was felt
};

/// `what`: "force" or "moment"; `unit`: N or N m.
struct PushedSensor {
  const char* what = "force";
  const char* unit = "N";
  Vector3 rest = Vector3::Zero();  // told while nobody touched it
  double rest_max = 2.0;           // more than that is no zero
  std::array<Push, 3> push{};
};

std::vector<Finding> judge_pushes(const PushedSensor& sensor);

}  // namespace longreach
