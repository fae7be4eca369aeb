#pragma once
// `longreach adapter check --push`: asks a person to push a robot's tool and to turn it, and looks at what
// the adapter then tells. The robot is sent no motion meanwhile.

#include <string>

#include "deploy/cli/finding.hpp"

namespace longreach {

/// `robot_file`: of the robot, for where its tool points. `patience_s`: to wait for each push. Prompts go to
/// standard output. Throws UsageError, AddressError.
Section check_pushes(const std::string& address, const std::string& robot_file, double push_timeout_s);

}  // namespace longreach
