#include "common/link/hold_cause.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace longreach {
namespace {

using By = HoldAttribution;

// Remedies of several lines.
constexpr const char* kJointOutsideRemedy =
    "check robot_file and the adapter's units, or move the joint back with the robot's own controls; then engage";
constexpr const char* kForcePersistsRemedy =
    "check whether an object is moving towards the robot or is attached to it, or raise "
    "command.guard_stiffness_n_per_m; then engage";
constexpr const char* kHandleOutsideRemedy =
    "check the adapter's unit of length (metres), the order of its quaternion (w x y z) and device_file with "
    "longreach adapter check --device-file; then engage";
constexpr const char* kSensorConstantRemedy =
    "check the sensor and its adapter; if the robot has no force sensor, start the slave with sensing.force: "
    "false (or, without moments, sensing.moment: false); if the sensor is simulated or coarse, set "
    "sensing.force_noise_n and sensing.moment_noise_nm to 0, or the resolutions of the sensor; then engage";

constexpr std::array<CauseText, kCountOf<HoldCause>> kCauses = {{
    {"", "", "", By::kProtection},
    {"operator", "requested by the operator or a client", "engage to resume", By::kOperator},
    {"link silent", "no datagrams arrive from the other side", "check the link, then engage", By::kOutage},
    {"link stale", "the data used by the other side is too old",
     "wait until the link recovers, or start the slave with a larger safety.age_max_s; then engage",
     By::kOutage},
    {"peer restarted", "the other side restarted", "engage to resume", By::kProtection},
    {"peer holds", "the other side holds", "check the other side, then engage", By::kProtection},
    {"robot fault", "the robot reports a fault",
     "clear the fault or restart the robot's adapter, then engage", By::kFault},
    {"device fault", "the haptic device reports a fault",
     "reconnect the device, or restart its adapter or the master; then engage", By::kFault},
    {"handle released", "no hand is on the handle", "grasp the handle, then engage", By::kOperator},
    {"preempted", "another master took control of the robot",
     "to take control back, start longreach-master with --take", By::kOperator},
    {"uncommanded motion", "the robot moves although its setpoint is at rest",
     "check the robot and its adapter, then engage", By::kFault},
    {"tracking lost", "the robot does not follow its setpoints",
     "check the robot, its adapter and robot_file, then engage", By::kFault},
    {"unanswered", "the slave did not respond to the request to engage",
     "check the link and the slave's log, then engage again", By::kFault},
    {"stalled", "the control loop of one side stalled",
     "that side's machine is busy: run longreach doctor there, then engage", By::kMachine},
    {"overrun", "the control loop of one side cannot maintain its rate",
     "that side's machine is too slow or too busy: run longreach doctor there, then engage", By::kMachine},
    {"delay rose", "the link delay increased", "engage to accept the new delay", By::kProtection},
    {"hand stale", "no new data arrives from the input device", "move or reconnect the device, then engage",
     By::kFault},
    {"sensor fault", "the force sensor reports values that no contact can cause",
     "check the sensor with longreach adapter check --push, then engage", By::kFault},
    {"sensor sign", "the force grows while the robot retreats",
     "check the sign and frame of the force sensor with longreach adapter check --push, then engage",
     By::kFault},
    {"force persists", "the force does not fall while the robot retreats", kForcePersistsRemedy, By::kFault},
    {"joint jumped", "a joint position changed faster than the joint can move",
     "check the joint's encoder, then restart the robot's adapter", By::kFault},
    {"joint outside", "a joint position is far beyond its limits", kJointOutsideRemedy, By::kFault},
    {"joint too fast", "a joint reports an impossible speed", "check the joint's encoder, then engage",
     By::kFault},
    {"joint limit", "a joint is beyond its limit",
     "move the joint back with the robot's own controls, then engage", By::kFault},
    {"robot moves", "the robot is not at rest", "wait until it is at rest, then engage", By::kProtection},
    {"tool outside", "the tool is outside its workspace",
     "move the tool back with the robot's own controls, or start the slave with a larger command.workspace_m; "
     "then engage",
     By::kFault},
    {"sensor zeroing", "the force sensor is being zeroed",
     "keep the tool free of contact for sensing.zero_s, then engage", By::kProtection},
    {"surface approaching", "a surface is moving towards the robot", "engage, then retreat from the surface",
     By::kProtection},
    {"handle jumped", "the position of the handle changed faster than a hand can move it",
     "check the device's encoders, its adapter and the adapter's unit of length (metres), then engage",
     By::kFault},
    {"handle outside", "the handle is far outside the workspace of the device file", kHandleOutsideRemedy,
     By::kFault},
    {"sensor constant", "the force sensor has reported only one value since the start", kSensorConstantRemedy,
     By::kFault},
}};

constexpr const char* kBurstsRemedy =
    "the datagrams probably arrive in bursts: switch off power saving of the Wi-Fi (iw dev NAME set power_save "
    "off), or start the slave with a larger safety.gap_s; then engage";

constexpr CauseText kUnknown{"unknown", "unknown", "see the log", By::kFault};

/// Returns for example "+x" for 1 and "-z" for -3; empty if `value` is not an axis.
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
  if (r.cause == HoldCause::kHandleJumped && r.limit > 0.0)
    return "the position of the handle jumped by " + rounded(r.value) + " m; a hand moves it by at most " +
           rounded(r.limit) + " m in that time";
  if (r.cause == HoldCause::kHandleOutside && r.limit > 0.0)
    return "the handle is " + rounded(r.value) + " m from its home position, beyond " + rounded(r.limit) +
           " m, 1.5 times the workspace of the device file";
  if (r.cause == HoldCause::kLinkSilent && r.limit > 0.0)
    return rounded(r.value) + " times within " + rounded(kSilentHoldsWithin_s) +
           " s, no datagram arrived for longer than safety.gap_s (" + rounded(r.limit) + " s)";
  if (r.cause == HoldCause::kSensorConstant && r.value == 1.0)
    return "the force sensor has reported only one value of the moment since the start";
  const std::string out = r.cause == HoldCause::kSurfaceApproaching ? axis(r.value) : std::string();
  if (!out.empty()) return std::string(text_of(r.cause).sentence) + "; the direction of retreat is " + out;
  if (r.joint == 0) return std::string(text_of(r.cause).sentence);
  switch (r.cause) {
    case HoldCause::kJointJumped:
      return joint + "jumped from " + rounded(r.limit) + " to " + rounded(r.value) +
             " rad (or m), faster than the joint can move";
    case HoldCause::kJointOutside:
    case HoldCause::kJointLimit:
      return joint + "is at " + rounded(r.value) + " rad (or m), beyond its limit of " + rounded(r.limit);
    case HoldCause::kJointTooFast:
      return joint + "reports " + rounded(r.value) + " rad/s (or m/s), which is impossible";
    case HoldCause::kRobotMoves:
      return joint + "moves at " + rounded(r.value) + " rad/s (or m/s)";
    default:
      return std::string(text_of(r.cause).sentence) + " (joint " + std::to_string(r.joint) + ")";
  }
}

std::string_view remedy(const Reason& r) {
  return r.cause == HoldCause::kLinkSilent && r.limit > 0.0 ? kBurstsRemedy : text_of(r.cause).remedy;
}

std::string with_remedy(const Reason& reason) {
  if (reason == HoldCause::kNone) return "";
  return sentence(reason) + "; " + std::string(remedy(reason));
}

}  // namespace longreach
