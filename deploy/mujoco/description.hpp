#pragma once
// The robot file (proto/config_slave.proto, message Robot) of the arm in an MJCF file.

#include <string>

#include "deploy/mujoco/world.hpp"
#include "proto/config_slave.pb.h"

namespace longreach {

/// Maximum difference between a robot file and the arm of the MJCF, m and rad.
constexpr double kSamePose = 1e-9;

/// Returns the description of the arm: that which the slave reads from the file if it is a URDF. Throws
/// std::invalid_argument if it does not have six joints or a joint has no limits.
proto::Robot describe(const MujocoWorld& world, const std::string& file);

/// Throws std::invalid_argument if the tool of `robot`, which `name` names, is elsewhere than that of `world` at some of 20
/// drawn positions of the joints by more than kSamePose.
void require_same(const proto::Robot& robot, const std::string& name, const MujocoWorld& world,
                  const std::string& file);

}  // namespace longreach
