#include "common/link/hold_cause.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace longreach {
namespace {

using Blame = HoldBlame;

constexpr std::array<CauseText, static_cast<std::size_t>(HoldCause::kCount)> kCauses = {{
    {"", "", "", Blame::kSystem},
    {"operator", "the operator or a client asked for it", "engage to go on", Blame::kOperator},
    {"link silent", "no datagram comes from the other side", "check the link, then engage", Blame::kOutage},
    {"link stale", "the news that the other side acts on is too old",
     "wait for the link, or start the slave with a larger safety.age_max_s; then engage", Blame::kOutage},
    {"peer restarted", "the other side has restarted", "engage", Blame::kSystem},
    {"peer holds", "the other side holds", "look at the other side, then engage", Blame::kSystem},
    {"robot fault", "the robot reports a fault", "mend it or start its adapter again, then engage",
     Blame::kSystem},
    {"device fault", "the haptic device reports a fault",
     "plug it in, or start its adapter or the master again; then engage", Blame::kSystem},
    {"handle let go", "no hand is on the handle", "take hold of the handle, then engage", Blame::kOperator},
    {"taken", "another master has taken the robot",
     "take it back with longreach-master --take, if it is yours", Blame::kOperator},
    {"robot restless", "the robot moves though it should be at rest",
     "check the robot and its adapter, then engage", Blame::kSystem},
    {"robot astray", "the robot does not follow its setpoints",
     "check the robot, its adapter and robot_file, then engage", Blame::kSystem},
    {"unanswered", "the slave has not answered", "check the link and the slave's log, then engage again",
     Blame::kSystem},
    {"stalled", "the control loop of one side stood still",
     "its machine is busy: longreach doctor; then engage", Blame::kMachine},
    {"overrun", "the control loop of one side does not keep its rate",
     "its machine is too slow or busy: longreach doctor; then engage", Blame::kMachine},
    {"delay rose", "the delay of the link has risen", "engage to accept the new delay", Blame::kSystem},
    {"hand stale", "nothing new comes from the hand", "move it, or connect it again; then engage",
     Blame::kSystem},
    {"sensor fault", "the force sensor reports what no contact can cause",
     "check it with longreach adapter check --push, then engage", Blame::kSystem},
    {"sensor sign", "the force grows as the robot gives way",
     "check sign and frame of the force sensor with longreach adapter check --push, then engage",
     Blame::kSystem},
    {"no relief", "the force does not fall as the robot gives way",
     "look for what comes towards the robot or is carried by it, or raise command.guard_stiffness_n_per_m; "
     "then "
     "engage",
     Blame::kSystem},
    {"joint leapt", "a joint has leapt as no joint can",
     "look at its encoder, then start the robot's adapter again", Blame::kSystem},
    {"joint outside", "a joint reports a place far beyond its limits",
     "check robot_file and the units of the adapter, or move it back by the robot's own means; then engage",
     Blame::kSystem},
    {"joint too fast", "a joint reports a speed that no joint can have", "look at its encoder, then engage",
     Blame::kSystem},
    {"joint limit", "a joint stands beyond its limit", "move it back by the robot's own means, then engage",
     Blame::kSystem},
    {"robot moves", "the robot is not at rest", "wait until it is at rest, then engage", Blame::kSystem},
    {"tool outside", "the tool is outside of its workspace",
     "move it back by the robot's own means, or start the slave with a larger command.workspace_m; then "
     "engage",
     Blame::kSystem},
    {"sensor zeroing", "the force sensor is being zeroed",
     "leave the tool untouched for sensing.zero_s, then engage", Blame::kSystem},
    {"wall comes", "something is moving towards the robot", "engage and retreat from it", Blame::kSystem},
}};

constexpr CauseText kUnknown{"unknown", "unknown", "see the log", Blame::kSystem};

/// "+x" of 1, "-z" of -3; of no axis nothing.
std::string axis(double value) {
  for (int i = 1; i <= 3; ++i)
    if (std::abs(value) == i) return std::string(value > 0.0 ? "+" : "-") + "xyz"[i - 1];
  return {};
}

std::string rounded(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
  return {text, end};
}

}  // namespace

const CauseText& text_of(HoldCause cause) {
  const auto index = static_cast<std::size_t>(cause);
  return index < kCauses.size() ? kCauses[index] : kUnknown;
}

std::string sentence(const Reason& r) {
  const std::string joint = "joint " + std::to_string(r.joint) + " of the robot ";
  if (r.cause == HoldCause::kToolOutside && r.limit > 0.0)
    return "the tool is " + rounded(r.value) + " m from the centre of its workspace, whose radius is " +
           rounded(r.limit) + " m";
  const std::string out = r.cause == HoldCause::kWallComes ? axis(r.value) : std::string();
  if (!out.empty()) return std::string(text_of(r.cause).sentence) + ", the way out is along " + out;
  if (r.joint == 0) return std::string(text_of(r.cause).sentence);
  switch (r.cause) {
    case HoldCause::kJointLeapt:
      return joint + "has leapt from " + rounded(r.limit) + " to " + rounded(r.value) +
             " rad (or m), as no joint can";
    case HoldCause::kJointOutside:
    case HoldCause::kJointLimit:
      return joint + "is at " + rounded(r.value) + " rad (or m), beyond its limit of " + rounded(r.limit);
    case HoldCause::kJointTooFast:
      return joint + "reports " + rounded(r.value) + " rad/s (or m/s), as no joint can";
    case HoldCause::kRobotMoves:
      return joint + "moves at " + rounded(r.value) + " rad/s (or m/s)";
    default:
      return std::string(text_of(r.cause).sentence) + " (joint " + std::to_string(r.joint) + ")";
  }
}

std::string with_remedy(const Reason& reason) {
  if (reason == HoldCause::kNone) return "";
  return sentence(reason) + "; " + std::string(text_of(reason).remedy);
}

}  // namespace longreach
