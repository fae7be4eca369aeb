#pragma once
// Sent by the master to the slave: one absolute, idempotent goal per period. The command with the highest
// sequence number takes precedence, so a lost command only causes delay. The goal is a displacement from the
// engagement's anchor, the measured pose of the tool when the slave accepted the engagement. The first goal
// is zero, so that engaging cannot cause a jump.

#include <cstdint>
#include <optional>

#include "common/spatial/spatial.hpp"
#include "schema/config_common.hpp"

namespace longreach {

/// State that the master requests, sent in every datagram.
enum class Request : std::uint8_t {
  kHold = 0,
  kEngage = 1,
  kStop = 2,
  kLetGo = 3  // hold, because no hand is on the handle; a prompt kEngage with this number resumes motion
};
enum class GoalKind : std::uint8_t { kPosition = 0, kOrientation = 1 };

struct MotionCommand {
  std::uint32_t engagement = 0;  // number of the requested engagement; 0: never engaged
  Request request = Request::kHold;
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;                        // k_scale, 0.05 to 1
  std::optional<bool> grip{};                // requested gripper state, true: closed; none: unchanged
  bool let_go = false;                       // no hand is on the handle
  GoalKind goal_kind = GoalKind::kPosition;  // which of the following goals this datagram carries
  Vector3 position_m = Vector3::Zero();      // goal minus anchor, in W
  /// Rotation vector v from anchor to goal, in W: R_goal = exp(v) R_anchor.
  Vector3 rotation_rad = Vector3::Zero();
};

}  // namespace longreach
