#pragma once
// What an arm can do, from its description: how far the tool gets, where it loses a direction.

#include <optional>
#include <string>
#include <vector>

#include "slave/kinematics/inverse.hpp"

namespace longreach {

/// A pose in which the tool cannot move in one direction, found from the start by moving one joint.
struct SingularPose {
  int joint = 0;                   // that was moved, from 0
  double value = 0.0;              // rad or m
  Vector6 lost = Vector6::Zero();  // unit [angular times length; linear], in W
};

struct RobotReport {
  RobotConfig robot{};
  std::string inverse{};
  JointVector start = JointVector::Zero();
  Pose X_WE{};                // at the start
  double conditioning = 0.0;  // there: 0 at a singular pose, about 0.3 at a good one
  double near_m = 0.0,
         far_m = 0.0;  // of the tool from the first axis' foot, over 20,000 places within the limits
  std::vector<SingularPose> singular{};
  std::vector<std::string> cannot{};  // sentences
};

RobotReport report_of(const RobotConfig& robot);

/// For people; ends with a new line.
std::string report_text(const RobotReport& report);
std::string report_json(const RobotReport& report);

/// "turn about x", "move along -z"; the larger part of a lost direction.
std::string direction_text(const Vector6& lost);

}  // namespace longreach
