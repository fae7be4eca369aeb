#include "master/console/situation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/link/boundary_words.hpp"
#include "master/console/formatted.hpp"
#include "master/console/snapshot.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

constexpr double kFelt_n = 0.05, kFelt_nm = 0.002;  // smaller forces are not perceptible
constexpr double kAgeNoticed_s = 0.1;

constexpr std::array<SituationText, static_cast<std::size_t>(Situation::kCount)> kSituations = {{
    {"connecting", "the first answer of the slave has not arrived yet",
     "wait for one round trip; if nothing changes, run longreach doctor"},
    {"ready", "the robot is at rest and does not follow the hand", "engage to take control"},
    {"engaging", "an engagement is requested, and the slave's answer has not arrived yet", "wait"},
    {"not engaged", "an engagement was requested and not granted", "see the reason in the sentence"},
    {"free motion", "the robot follows the hand and touches nothing", "move"},
    {"lagging", "the robot follows the hand more slowly, because a speed limit acts",
     "move more slowly, or wait for the robot"},
    {"at a limit",
     "the robot cannot move further in this direction: a joint, its reach or its workspace ends",
     "move back"},
    {"clutch", "the hand moves without the robot, which holds its position",
     "release the clutch to move the robot"},
    {"handle released", "no hand is on the handle, and the robot stays at the last goal",
     "grasp the handle, or stop the robot"},
    {"bring the handle home",
     "rate mode began while the handle was not in its dead zone, and the robot stays until it has been there",
     "move the handle to its home position"},
    {"measuring", "the robot touches a surface whose stiffness is not known yet, and the hand feels nothing",
     "press for some tenths of a second and one round trip"},
    {"touching", "the robot touches a surface, and the hand feels its stiffness", "press, or retreat"},
    {"felt less", "the hand feels less than the surface demands, because the energy for the force is lacking",
     "wait until the goal has moved out, or retreat and touch the surface again"},
    {"guarded", "a force or moment guard keeps the robot from pressing harder",
     "retreat to reduce the force"},
    {"pushed back", "a surface moves towards the robot, which retreats", "retreat from the surface"},
    {"unsteady", "the contact changes faster than its stiffness can be measured",
     "retreat, or wait until it is steady"},
    {"leaving", "the hand has left the surface, and the robot follows after the delay of the link", "wait"},
    {"remembered",
     "the hand feels a surface that is known from an earlier touch, and the robot does not touch it",
     "press, or retreat"},
    {"holding", "the robot holds its position because of the cause in the sentence", "see the causes below"},
    {"silent", "nothing arrives from the slave, and the robot holds its position",
     "check the link; engage when it has recovered"},
    {"recovered", "nothing arrived from the slave for some time, and the link works again",
     "engage to resume"},
    {"slave restarted", "the slave was restarted, and the surfaces that were known are not known any more",
     "engage to resume"},
    {"stopped", "the operator or a client stopped the robot", "engage to resume"},
    {"fault", "the robot, the haptic device or the input of the hand has failed",
     "see the causes below: repair the fault, then engage"},
}};

bool heard(const ConsoleSnapshot& s) { return s.view.far_known || std::isfinite(s.link.silence_s); }

/// Returns whether the robot lags visibly. A limit that causes a smaller lag does not deserve a warning.
bool lags(const Telemetry& robot) {
  constexpr double kLag_m = 0.01;
  return (robot.X_WE_goal.p - robot.X_WE.p).norm() > kLag_m;
}

/// Returns whether the report of the robot refers to the present engagement.
bool reported(const MasterView& view) { return view.far_known && view.far.engagement == view.engagement; }

/// Returns whether the contact is one by rotation alone.
bool by_rotation(const MasterView& view) {
  if (view.spring_force_n.norm() > kFelt_n) return false;
  if (view.spring_moment_nm.norm() > kFelt_nm) return true;
  return !(view.surface_n_per_m > 0.0) && view.stop_nm_per_rad > 0.0;
}

bool felt(const MasterView& view) {
  return view.spring_force_n.norm() > kFelt_n || view.spring_moment_nm.norm() > kFelt_nm;
}

/// Returns how old the statement about the robot is, as text.
std::string as_of(const ConsoleSnapshot& s) {
  const auto age_s = age_of_news_s(s);
  return age_s && *age_s >= kAgeNoticed_s ? formatted(" (%.1f s ago)", *age_s) : "";
}

/// Returns the forces at both ends, if there is a contact, and the age of what is known of the robot.
std::string ends(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (!v.in_contact || !v.far_known) return as_of(s);
  if (by_rotation(v))
    return formatted(": %.2f N m at the hand, %.2f N m at the tool", v.spring_moment_nm.norm(),
                     v.far.F_E_W.moment.norm()) +
           as_of(s);
  return formatted(": %.1f N at the hand, %.1f N at the tool", v.spring_force_n.norm(),
                   v.far.F_E_W.force.norm()) +
         as_of(s);
}

/// Returns the force with which the robot presses while the hand does not act, if there is a contact.
std::string pressing(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (!v.in_contact || !v.far_known) return as_of(s);
  return formatted("; it presses with %.1f N", v.far.F_E_W.force.norm()) + as_of(s);
}

std::string stiffness(const MasterView& v) {
  if (by_rotation(v)) return formatted("a stop of %.3g N m/rad", v.stop_nm_per_rad);
  // The situation may outlast what is known of the surface.
  return v.surface_n_per_m > 0.0 ? formatted("a surface of %.2f N/mm", 1e-3 * v.surface_n_per_m)
                                 : "a surface";
}

Situation in_contact(const ConsoleSnapshot& s, const ContactCourse& course) {
  constexpr double kWithheld_n = 0.5, kWithheld = 0.2;
  const MasterView& v = s.view;
  if (course.pushed_m > 0.0) return Situation::kPushedBack;
  if (course.unsteady) return Situation::kUnsteady;
  const double felt_n = v.spring_force_n.norm();
  const bool turned = by_rotation(v);
  if (!turned && !(v.surface_n_per_m > 0.0)) return Situation::kMeasuring;
  if (v.mode == MotionMode::kPosition && !felt(v) && v.surface_known && v.inward.dot(v.p_MH) < v.surface_m)
    return Situation::kLeaving;
  if (v.withheld_n > std::max(kWithheld_n, kWithheld * (felt_n + v.withheld_n))) return Situation::kFeltLess;
  if (reported(v) && (v.far.clamps.force_guard || v.far.clamps.moment_guard)) return Situation::kGuarded;
  return Situation::kTouching;
}

Situation engaged(const ConsoleSnapshot& s, const ContactCourse& course) {
  const MasterView& v = s.view;
  if (v.clutched) return Situation::kClutch;
  if (!v.held) return Situation::kReleased;
  if (v.bring_home || v.turn_home) return Situation::kBringHome;
  if (v.in_contact) return in_contact(s, course);
  if (reported(v)) {
    const Clamps& robot = v.far.clamps;
    if (robot.joint_position || robot.unreachable || robot.workspace) return Situation::kAtLimit;
    if (robot.force_guard || robot.moment_guard) return Situation::kGuarded;
  }
  if (felt(v)) return Situation::kRemembered;
  const bool slow = reported(v) && lags(v.far) &&
                    (v.far.clamps.singularity || v.far.clamps.joint_speed || v.far.clamps.tool_speed);
  return slow ? Situation::kSlow : Situation::kFree;
}

Situation holding(const MasterView& v) {
  const bool fault = v.far_state == SafetyState::kFault ||
                     (text_of(v.cause).attribution == HoldAttribution::kFault && !v.resumes);
  if (v.cause == HoldCause::kLinkSilent && !v.cause_is_far)
    return v.silent ? Situation::kSilent : Situation::kRecovered;
  if (v.cause == HoldCause::kPeerRestarted) return Situation::kRestarted;
  return fault ? Situation::kFault : Situation::kHolding;
}

Situation observing(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (v.silent) return Situation::kSilent;
  if (v.engaging && v.refusal == HoldCause::kNone)
    return v.answer_in_s ? Situation::kEngaging : Situation::kConnecting;
  if (v.refusal != HoldCause::kNone) return Situation::kRefused;
  if (v.far_state == SafetyState::kFault) return Situation::kFault;
  return v.cause != HoldCause::kNone && !v.hand_missing ? Situation::kRefused : Situation::kReady;
}

std::string ready(const ConsoleSnapshot& s) {
  return s.view.hand_missing ? "ready: the robot is at rest; grasp the handle to engage"
                             : "ready: the robot is at rest; engage to take control";
}

std::string connecting(const ConsoleSnapshot& s) {
  const auto trip_s = s.link.rtt_s ? s.link.rtt_s : s.expected_rtt_s;
  return "waiting for the first answer of the slave" + (trip_s ? formatted(" (%.1f s)", *trip_s) : "");
}

std::string engaging(const ConsoleSnapshot& s) {
  const double trip_s = s.link.rtt_s.value_or(0.0), left_s = s.view.answer_in_s.value_or(0.0);
  if (left_s < 0.05) return formatted("engaging: the slave's answer is due (round trip %.2f s)", trip_s);
  return formatted("engaging: the slave's answer is due in %.1f s (round trip %.2f s)", left_s, trip_s);
}

std::string refused(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (v.refusal == HoldCause::kNone)
    return "not engaged: " + cause_in_words(v) + "; " + std::string(remedy(v.cause));
  return (v.engaging ? "engaging, but not yet accepted: " : "not engaged: ") + refusal_in_words(v);
}

std::string slow(const ConsoleSnapshot& s) {
  const Clamps& robot = s.view.far.clamps;
  if (robot.singularity) return "the robot follows slowly near a singular pose" + as_of(s);
  if (robot.joint_speed) return "the robot lags because a joint is at its speed limit" + as_of(s);
  return "the robot lags because the tool is at its speed limit" + as_of(s);
}

std::string at_limit(const ConsoleSnapshot& s) {
  const Telemetry& robot = s.view.far;
  const std::string end = boundary_in_words(robot.clamps, robot.X_WE, robot.X_WE_goal);
  std::string text = "the robot cannot move further: " + (end.empty() ? "edge of its workspace" : end);
  if (felt(s.view) && !s.view.in_contact)
    text += formatted("; the hand feels %.1f N", s.view.spring_force_n.norm());
  return text + ends(s);
}

std::string free_motion(const ConsoleSnapshot& s) {
  const bool rate = s.view.mode == MotionMode::kRate;
  return (rate ? "free motion: the deflection of the hand sets the speed of the robot"
               : formatted("free motion: the robot follows the hand, scaled by %.2f", s.view.scale)) +
         (s.turns ? "" : "; its orientation is constant, because this handle does not turn") + ends(s);
}

std::string bring_home(const ConsoleSnapshot& s) {
  return (s.view.bring_home ? "bring the handle home: until then, rate mode does not move the robot"
                            : "turn the handle home: until then, rate mode does not turn the robot") +
         pressing(s);
}

std::string held(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (v.cause == HoldCause::kNone || (v.cause == HoldCause::kHandleReleased && !v.hand_missing))
    return "holding: engage to resume" + pressing(s);
  if (v.cause == HoldCause::kDelayRose && !v.cause_is_far && v.rtt_s && v.rtt_least_s)
    return formatted("holding: the round trip rose from %.2f to %.2f s; engage to accept the new delay",
                     *v.rtt_least_s, *v.rtt_s) +
           pressing(s);
  return "holding: " + cause_in_words(v) + "; " +
         (v.resumes ? "the robot resumes automatically if this ends soon" : std::string(remedy(v.cause))) +
         pressing(s);
}

std::string silent(const ConsoleSnapshot& s) {
  std::string text =
      formatted("nothing received from the slave for %.1f s: the robot holds", s.link.silence_s);
  return text + (s.view.resumes ? "" : "; engage when the link has recovered");
}

std::string recovered(const ConsoleSnapshot& s) {
  return formatted("holding: nothing was received from the slave for %.1f s; the link has recovered: ",
                   s.view.hold_silence_s) +
         (s.view.resumes ? "the robot resumes automatically" : "engage to resume") + pressing(s);
}

std::string stopped(const ConsoleSnapshot& s) {
  if (s.view.refusal != HoldCause::kNone) return "stopped: not engaged: " + refusal_in_words(s.view);
  const bool far = s.view.cause_is_far && s.view.cause == HoldCause::kOperator;
  return std::string(far ? "stopped at the slave" : "stopped by the operator or a client") +
         "; engage to resume" + pressing(s);
}

std::string fault(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  if (v.state == SafetyState::kObserving) {
    const std::string why = v.far_known ? sentence(v.far.cause) : "";
    return "fault at the slave" + (why.empty() ? "" : ": " + why) +
           "; engage after the fault has been cleared";
  }
  if (v.refusal != HoldCause::kNone) return "fault: not engaged: " + refusal_in_words(v);
  return "fault: " + cause_in_words(v) + "; " + std::string(remedy(v.cause)) + pressing(s);
}

std::string guarded(const ConsoleSnapshot& s) {
  const bool turns = s.view.far.clamps.moment_guard && !s.view.far.clamps.force_guard;
  return std::string(turns ? "the moment guard keeps the robot from turning further"
                           : "the force guard keeps the robot from pressing harder") +
         ends(s);
}

std::string felt_less(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  const double felt_n = v.spring_force_n.norm();
  return formatted("touching %s, felt less: %.1f of %.1f N at the hand", stiffness(v).c_str(), felt_n,
                   felt_n + v.withheld_n) +
         (v.far_known ? formatted(", %.1f N at the tool", v.far.F_E_W.force.norm()) : "") + as_of(s);
}

std::string leaving(const ConsoleSnapshot& s) {
  const double one_way_s = 0.5 * s.link.rtt_s.value_or(0.0);
  return "the hand has left the surface; the robot follows" +
         (one_way_s >= kAgeNoticed_s ? formatted(" %.1f s later", one_way_s) : "") + ends(s);
}

std::string remembered(const ConsoleSnapshot& s) {
  const MasterView& v = s.view;
  const std::string force = by_rotation(v) ? formatted("%.2f N m", v.spring_moment_nm.norm())
                                           : formatted("%.1f N", v.spring_force_n.norm());
  return "the hand feels " + stiffness(v) + " with " + force + "; the robot does not touch it" + as_of(s);
}

}  // namespace

const SituationText& text_of(Situation situation) {
  static constexpr SituationText kUnknown{"unknown", "unknown", "see the log"};
  const auto index = static_cast<std::size_t>(situation);
  return index < kSituations.size() ? kSituations[index] : kUnknown;
}

bool is_motion(Situation situation) {
  return situation >= Situation::kFree && situation <= Situation::kRemembered;
}

Situation situation_of(const ConsoleSnapshot& s, const ContactCourse& course) {
  if (!heard(s)) return s.view.state == SafetyState::kFault ? Situation::kFault : Situation::kConnecting;
  switch (s.view.state) {
    case SafetyState::kIdle:
    case SafetyState::kObserving:
      return observing(s);
    case SafetyState::kEngaged:
      return engaged(s, course);
    case SafetyState::kHolding:
      return holding(s.view);
    case SafetyState::kStopped:
      return Situation::kStopped;
    case SafetyState::kFault:
      break;
  }
  return Situation::kFault;
}

std::string sentence_of(Situation situation, const ConsoleSnapshot& s, const ContactCourse& course) {
  if (!is_motion(situation) && s.view.state == SafetyState::kEngaged)
    return "the robot follows the hand" + ends(s);
  switch (situation) {
    case Situation::kConnecting:
      return connecting(s);
    case Situation::kReady:
      return ready(s);
    case Situation::kEngaging:
      return engaging(s);
    case Situation::kRefused:
      return refused(s);
    case Situation::kFree:
      return free_motion(s);
    case Situation::kSlow:
      return slow(s);
    case Situation::kAtLimit:
      return at_limit(s);
    case Situation::kClutch:
      return "clutch: the hand moves freely, the robot stays in place" + pressing(s);
    case Situation::kReleased:
      return "no hand is on the handle; the robot stays in place" + pressing(s);
    case Situation::kBringHome:
      return bring_home(s);
    case Situation::kMeasuring:
      return "touching a surface whose stiffness is not known yet" + ends(s);
    case Situation::kTouching:
      return "touching " + stiffness(s.view) + ends(s);
    case Situation::kFeltLess:
      return felt_less(s);
    case Situation::kGuarded:
      return guarded(s);
    case Situation::kPushedBack:
      return formatted("a surface has pushed the robot back by %.0f mm", 1e3 * course.pushed_m) + ends(s);
    case Situation::kUnsteady:
      return "the contact changes faster than its stiffness can be measured" + ends(s);
    case Situation::kLeaving:
      return leaving(s);
    case Situation::kRemembered:
      return remembered(s);
    case Situation::kHolding:
      return held(s);
    case Situation::kSilent:
      return silent(s);
    case Situation::kRecovered:
      return recovered(s);
    case Situation::kRestarted:
      return "holding: the slave was restarted, and known surfaces are gone; engage to resume" + as_of(s);
    case Situation::kStopped:
      return stopped(s);
    case Situation::kFault:
      return fault(s);
    case Situation::kCount:
      break;
  }
  return "unknown situation";
}

}  // namespace longreach
