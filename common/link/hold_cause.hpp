#pragma once
// Causes why a side does not follow: one table for both sides and for all code that shows, logs, records or
// evaluates a cause. The number is the one on the wire and in recordings (proto/recording.proto, Cause). The
// name, for status and log, is a lower-case word or two.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// First cause of leaving Engaged, or of refusing an engagement.
enum class HoldCause : std::uint8_t {
  kNone,
  kOperator,
  kLinkSilent,     // gap timer: no datagram
  kLinkStale,      // age bound
  kPeerRestarted,  // the other side began a new session
  kPeerHolds,
  kRobotFault,
  kDeviceFault,
  kHandleLetGo,
  kTaken,
  kRobotUncommandedMotion,  // the robot moves although its setpoint is at rest
  kRobotTrackingLost,       // the robot does not follow its setpoints
  kUnanswered,              // the slave did not confirm an engagement
  kStalled,                 // this side was stalled for longer than its gap timer
  kOverrun,                 // more than half of the ticks of a second were late
  kDelayRose,               // the round trip exceeds its minimum since the engagement by more than the bound
  kHandStale,               // the state of the hand is too old
  kSensorFault,             // the force sensor reports values that no contact can cause
  kSensorSign,              // the force grows along a motion that should reduce it
  kForcePersists,           // the force does not fall while the robot retreats
  kJointLeapt,              // an impossible change of the joint readings
  kJointOutside,
  kJointTooFast,
  kJointLimit,   // beyond the limit by more than an engagement may start with
  kRobotMoves,   // not at rest before an engagement
  kToolOutside,  // outside command.workspace_m
  kSensorZeroing,
  /// an approaching surface: the force responds to the retreat but keeps growing; the retreat distance is
  /// used up
  kWallComes,
  kCount
};
inline constexpr HoldCause kLastCause = HoldCause::kWallComes;

/// Who is responsible, for the verdict of a run.
enum class HoldAttribution : std::uint8_t { kSystem, kMachine, kOperator, kOutage };

struct CauseText {
  std::string_view name;
  std::string_view sentence;  // without the position; no trailing full stop
  std::string_view remedy;    // suggested action
  HoldAttribution attribution = HoldAttribution::kSystem;
};
/// All texts are empty for kNone; for an invalid number they are "unknown".
const CauseText& text_of(HoldCause cause);

/// A cause and its position; converts to and from a cause without a position.
struct Reason {
  HoldCause cause = HoldCause::kNone;
  std::uint8_t joint = 0;  // from 1; 0: not a joint
  // rad or m, or per second for a speed: of the joint, or of the tool from the centre of the workspace; for
  // an approaching surface the axis of W along which the tool can retreat: 1, 2, 3 for x, y, z, negative for
  // the opposite direction
  double value = 0.0;
  double limit = 0.0;  // likewise: the limit, or the previous position of the joint

  constexpr Reason() = default;
  constexpr Reason(HoldCause of) : cause(of) {}
  constexpr Reason(HoldCause of, int joint_from_1, double is, double bound)
      : cause(of), joint(static_cast<std::uint8_t>(joint_from_1)), value(is), limit(bound) {}
  constexpr operator HoldCause() const { return cause; }
};
constexpr bool operator==(const Reason& a, HoldCause b) { return a.cause == b; }
/// The values may differ.
constexpr bool operator==(const Reason& a, const Reason& b) {
  return a.cause == b.cause && a.joint == b.joint;
}
/// "joint 5 is at 2.15 rad (or m), beyond its limit of 2.094"
std::string sentence(const Reason& reason);
/// The same with the remedy.
std::string with_remedy(const Reason& reason);

}  // namespace longreach
