#pragma once
// Master to slave: one absolute, idempotent goal per period. The newest sequence takes precedence, so a lost
// one only causes delay. The goal is a displacement from the engagement's anchor, the measured pose of the
// slave when it accepted the engagement: the first goal is zero and nothing can jump.

#include <cstdint>
#include <optional>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// Requested state, sent in every datagram.
enum class Request : std::uint8_t {
  kHold = 0,
  kEngage = 1,
  kStop = 2,
  kLetGo = 3  // hold, because no hand is on the handle; kEngage with the same number soon after resumes
};
enum class MotionMode : std::uint8_t { kRate = 0, kPosition = 1 };
enum class GoalKind : std::uint8_t { kPosition = 0, kOrientation = 1 };

struct MotionCommand {
  std::uint32_t engagement = 0;  // number of the requested engagement; 0: never engaged
  Request request = Request::kHold;
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;          // k_scale, 0.05 to 1
  std::optional<bool> grip{};  // requested state of the gripper, closed or open; none: unchanged
  bool let_go = false;         // no hand is on the handle; sent in every datagram
  GoalKind goal_kind = GoalKind::kPosition;  // which of the two goals below this datagram carries
  Vector3 position_m = Vector3::Zero();      // goal minus anchor, in W
  Vector3 rotation_rad =
      Vector3::Zero();  // rotation vector from anchor to goal, in W: R_goal = exp(v) R_anchor
};

}  // namespace longreach
