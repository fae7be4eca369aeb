#pragma once
// `longreach adapter check --push`: prompts the user to push and turn the tool of a robot, and checks the
// reports of the adapter. The robot is not moved.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// `robot_file`: file of the robot, for the orientation of its tool. `patience_s`: time limit for each push.
/// Prompts are printed on standard output. Throws UsageError, AddressError.
Section check_pushes(const std::string& address, const std::string& robot_file, double push_timeout_s);

}  // namespace longreach
