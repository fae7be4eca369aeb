#pragma once
// Parameters of the mapping from the motion of the handle to the goal of the robot. Each field is documented
// under the same name in proto/config.proto.

#include <cstdint>

#include "common/link/motion_command.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

enum class RateLaw : std::uint8_t { kContinuous = 0, kLiteral = 1 };

struct MappingConfig {
  MotionMode mode = MotionMode::kPosition;
  double scale = 0.8;
  RateLaw rate_law = RateLaw::kContinuous;
  double kv_per_s = 2.0;
  double kv_rotation_per_s = 0.5;
  double dead_zone_m = 0.005;
  double dead_zone_rad = 0.05;
  double radius_max_m = 0.05;
  double radius_max_rad = 0.5;
  double speed_max_m_per_s = 0.25;
  double speed_max_rad_per_s = 0.3;
  Vector3 base_rotation_rad = Vector3::Zero();
  bool goal_follows_force = true;
};

}  // namespace longreach
