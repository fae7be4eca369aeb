#pragma once
// Which refusals end a request for an engagement. A refusal because of a fault, a position that must be
// corrected or an operator's stop ends it: the fault may end at any time later, when the operator does not
// expect the robot to start. A refusal that ends by itself within seconds of normal operation does not: the request waits for
// the robot to come to rest, the sensor to be zeroed, and datagrams to arrive.
//
// Example: an engagement that is requested during a protective stop is refused with `robot fault`. When the
// robot is released 14 s later, it stays at rest until a new engagement is requested.

#include "common/link/hold_cause.hpp"

namespace longreach {

constexpr bool ends_request(HoldCause refusal) {
  switch (refusal) {
    case HoldCause::kRobotMoves:
    case HoldCause::kSensorZeroing:
    case HoldCause::kStalled:
    case HoldCause::kOverrun:
    case HoldCause::kLinkSilent:
    case HoldCause::kLinkStale:
    case HoldCause::kHandStale:
    case HoldCause::kHandleReleased:
    case HoldCause::kUnanswered:
    case HoldCause::kNone:
      return false;
    default:
      return true;
  }
}

}  // namespace longreach
