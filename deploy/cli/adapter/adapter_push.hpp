#pragma once
// `longreach adapter check --push`: prompts the user to push and turn the tool of a robot, and checks the
// forces and moments that the adapter reports. The robot is not commanded to move.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// Runs the check and prints the prompts on standard output. `robot_file` gives the orientation of the tool;
/// `push_timeout_s` is the time limit for each push. Throws UsageError or AddressError.
Section check_pushes(const std::string& address, const std::string& robot_file, double push_timeout_s);

}  // namespace longreach
