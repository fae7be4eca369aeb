#pragma once
// What an arm can do according to its description: how far the tool reaches, and where it loses a direction
// of motion.

#include <optional>
#include <string>
#include <vector>

#include "slave/kinematics/inverse.hpp"

namespace longreach {

/// A pose in which the tool cannot move in one direction, found by moving one joint from the start pose.
struct SingularPose {
  int joint = 0;                   // index of the moved joint, from 0
  double value = 0.0;              // position of that joint, rad or m
  Vector6 lost = Vector6::Zero();  // lost direction, unit vector [angular times length; linear], in W
};

struct RobotReport {
  RobotConfig robot{};
  std::string inverse{};
  JointVector start = JointVector::Zero();
  Pose X_WE{};                // start pose of the tool
  double conditioning = 0.0;  // conditioning of the start pose: 0 if singular, about 0.3 if good
  /// Minimum and maximum distance of the tool from the origin of the first joint's frame, over 20,000 poses
  /// within the joint limits.
  double near_m = 0.0, far_m = 0.0;
  std::vector<SingularPose> singular{};
  std::vector<std::string> cannot{};  // limitations of the arm, one sentence each
  /// Where the limits come from, such as "acceleration  default"; content of the file that is ignored.
  std::vector<std::string> limits{}, ignored{};
};

RobotReport report_of(const RobotConfig& robot);

/// The report as text for users; ends with a newline.
std::string report_text(const RobotReport& report);
std::string report_json(const RobotReport& report);

/// Describes the dominant part of a lost direction, for example "turn about x" or "move along z".
std::string direction_text(const Vector6& lost);

}  // namespace longreach
