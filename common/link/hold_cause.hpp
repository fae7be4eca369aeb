#pragma once
// Why a side does not follow: the one table of causes, for both sides and for whatever shows, logs, records
// or judges one. Number: as on the wire and in recordings (proto/recording.proto, Cause). Name: a word or
// two, for status and log; those of the recording in lower case.

#include <cstdint>
#include <string>
#include <string_view>

namespace longreach {

/// First cause of leaving Engaged, or of an engagement that is not granted.
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
  kRobotUncommandedMotion,  // it moves where it should be at rest
  kRobotTrackingLost,       // it does not follow its setpoints
  kUnanswered,              // the slave did not confirm an engagement
  kStalled,                 // this side stood still for longer than its gap timer
  kOverrun,                 // more than half of the ticks of a second came late
  kDelayRose,               // the round trip exceeds its least since the engagement by more than the bound
  kHandStale,               // the state of the hand is too old
  kSensorFault,             // the force sensor reports values that no contact can cause
  kSensorSign,              // the force grows along the motion that should relieve it
  kForcePersists,           // the force does not fall while the robot retreats
  kJointLeapt,              // joint readings that no joint can mean
  kJointOutside,
  kJointTooFast,
  kJointLimit,   // beyond it by more than an engagement may begin with
  kRobotMoves,   // not at rest before an engagement
  kToolOutside,  // of command.workspace_m
  kSensorZeroing,
  kWallComes,  // the force answers as the robot gives way, and goes on to come; the way is used up
  kCount
};
inline constexpr HoldCause kLastCause = HoldCause::kWallComes;

/// Whose doing it is, for the verdict of a run.
enum class HoldAttribution : std::uint8_t { kSystem, kMachine, kOperator, kOutage };

struct CauseText {
  std::string_view name;
  std::string_view sentence;  // without its place; no trailing stop
  std::string_view remedy;    // what to do
  HoldAttribution attribution = HoldAttribution::kSystem;
};
/// Of kNone all texts are empty; of a number that is no cause "unknown".
const CauseText& text_of(HoldCause cause);

/// A cause and where it is; it converts to and from a cause, so that one without a place is written as that.
struct Reason {
  HoldCause cause = HoldCause::kNone;
  std::uint8_t joint = 0;  // from 1; 0: not of a joint
  // rad or m, of a speed a second: the joint's, or of the tool from the workspace's centre; of a wall that
  // comes the axis of W along which the tool can retreat: 1, 2, 3 for x, y, z, negative against it
  double value = 0.0;
  double limit = 0.0;  // likewise: the limit, or where the joint was before

  constexpr Reason() = default;
  constexpr Reason(HoldCause of) : cause(of) {}
  constexpr Reason(HoldCause of, int joint_from_1, double is, double bound)
      : cause(of), joint(static_cast<std::uint8_t>(joint_from_1)), value(is), limit(bound) {}
  constexpr operator HoldCause() const { return cause; }
};
constexpr bool operator==(const Reason& a, HoldCause b) { return a.cause == b; }
/// How much it is may change.
constexpr bool operator==(const Reason& a, const Reason& b) {
  return a.cause == b.cause && a.joint == b.joint;
}
/// "joint 5 is at 2.15 rad (or m), beyond its limit of 2.094"
std::string sentence(const Reason& reason);
/// The same and what to do.
std::string with_remedy(const Reason& reason);

}  // namespace longreach
