#pragma once
// Slave to master: the only haptic quantity that crosses the link, the estimated stiffness, and where in the
// operator's own motion it was met. The renderer sees this type and nothing else from the far side.

#include <cstdint>

#include "common/spatial/spatial.hpp"

namespace longreach {

/// States of the safety machine; both sides show them.
enum class SafetyState : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// First cause of leaving Engaged.
enum class HoldCause : std::uint8_t {
  kNone,
  kOperator,       // asked for by the operator
  kLinkSilent,     // gap timer: nothing heard
  kLinkStale,      // age bound: what the other side acts on is too old
  kPeerRestarted,  // the other side began a new session
  kPeerHolds,      // the other side holds or stopped
  kRobotFault,
  kDeviceFault,
  kHandleLetGo,    // no hand on the handle
  kTaken,          // another master has taken the robot
  kRobotRestless,  // the robot moves where it should rest
  kRobotAstray,    // the robot does not follow its setpoints
  kUnanswered,     // the slave did not confirm an engagement
  kStalled,        // this side stood still for longer than its gap timer
  kOverrun,        // more than half of the ticks of a second came late
  kDelayRose,      // the round trip exceeds its least since the engagement by more than the bound
  kHandStale,      // the state of the hand is too old
  kSensorFault,    // the force sensor says what no contact could do
  kSensorSign,     // the force grows along the motion that should relieve it
  kNoRelief,       // the force does not fall as the robot gives way
  kCount
};

/// One contact, in translation or in rotation.
struct ContactStiffness {
  // Symmetric, positive semidefinite, in W: N/m (translation) or N m/rad (rotation); zero without contact.
  Matrix3 stiffness = Matrix3::Zero();
  // Which command's goal is the place of the surface, between sequences; 0 without a touch. Refined while the
  // contact lasts.
  double touch_sequence = 0.0;
  std::uint32_t touch = 0;  // counts touches from 1; a new number is a new contact
  bool in_contact = false;
  // How deep behind its surface the contact presses with twice the touch threshold, by its law, m or rad; 0:
  // not known.
  double proof_depth = 0.0;
  // The tool, from the engagement's anchor, in W: a displacement (m) or a rotation vector (rad).
  Vector3 place = Vector3::Zero();
  // Likewise the surface beneath the tool, where the touch is older than the engagement; zero: the goal at
  // touch_sequence is its place.
  Vector3 surface = Vector3::Zero();
  // Unit, in W: from the tool towards a goal from which a limit holds it back; zero: nothing does.
  Vector3 held_back = Vector3::Zero();
};

struct StiffnessReport {
  std::uint32_t engagement = 0;  // engagement that the slave follows or last followed
  SafetyState state = SafetyState::kIdle;
  HoldCause cause = HoldCause::kNone;
  ContactStiffness translation{};
  ContactStiffness rotation{};
  // Newest command whose goal the tool has reached.
  std::uint64_t reached_sequence = 0;
};

}  // namespace longreach
