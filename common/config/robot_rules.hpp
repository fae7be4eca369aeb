#pragma once
// Fields of a robot that must agree with each other.

#include "common/config/rule.hpp"
#include "proto/config.pb.h"

namespace longreach {

Finding check_joint(const proto::Joint& joint);
Finding check_robot(const proto::Robot& robot);

}  // namespace longreach
