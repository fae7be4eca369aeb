#pragma once
// Checks that the fields of a robot are consistent.

#include "common/config/rule.hpp"
#include "proto/config.pb.h"

namespace longreach {

Finding check_joint(const proto::Joint& joint);
Finding check_robot(const proto::Robot& robot);

}  // namespace longreach
