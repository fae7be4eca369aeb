#include "master/console/words.hpp"

#include <array>
#include <cmath>

#include "common/link/boundary_words.hpp"
#include "master/console/formatted.hpp"

namespace longreach {
namespace {

template <class Enum, std::size_t N>
std::string_view name_of(Enum value, const std::array<std::string_view, N>& names) {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : std::string_view("unknown");
}

bool heard(const ConsoleSnapshot& s) { return s.view.far_known || std::isfinite(s.link.silence_s); }

/// Returns how old the statements about the robot are.
std::string as_of(const ConsoleSnapshot& s) {
  constexpr double kNoticed_s = 0.1;
  const auto age_s = age_of_news_s(s);
  return age_s && *age_s >= kNoticed_s ? formatted(" (%.1f s ago)", *age_s) : "";
}

/// Returns whether the robot lags visibly. A limit that causes a smaller lag does not deserve a warning.
bool behind(const Telemetry& robot) {
  constexpr double kBehind_m = 0.01;
  return (robot.X_WE_goal.p - robot.X_WE.p).norm() > kBehind_m;
}

/// Returns which limit keeps the robot from following; empty if none does.
std::string held_back(const MasterView& view) {
  if (!view.far_known || view.far.engagement != view.engagement) return "";
  const Clamps& robot = view.far.clamps;
  if (robot.joint_position || robot.unreachable)
    return "the robot cannot move further: " + boundary_in_words(robot, view.far.X_WE, view.far.X_WE_goal);
  if (robot.workspace)
    return "the robot is at the edge of its workspace: it cannot move further in this direction";
  if (robot.force_guard) return "the force guard stops the robot from moving deeper";
  if (robot.moment_guard) return "the moment guard stops the robot from turning further";
  if (!behind(view.far)) return "";
  if (robot.singularity) return "the robot follows slowly near a singular pose";
  if (robot.joint_speed) return "the robot lags because a joint is at its speed limit";
  if (robot.tool_speed) return "the robot lags because the tool is at its speed limit";
  return "";
}

/// Returns whether the operator feels a rotational contact but no wall.
bool turned_against(const MasterView& view) {
  return view.spring_moment_nm.norm() > 0.0 && !(view.spring_force_n.norm() > 0.0);
}

std::string touching(const ConsoleSnapshot& s) {
  const double k = s.view.stiffness_n_per_m;
  if (turned_against(s.view))
    return formatted("contact by rotation: stop stiffness %.3g N m/rad",
                     s.view.rotational_stiffness_nm_per_rad);
  if (!(k > 0.0)) return "contact: the slave is still measuring the wall";
  const double force = s.view.spring_force_n.norm();
  if (s.view.mode == MotionMode::kPosition && !(force > 0.0)) {
    return formatted(
        "contact: the robot touches the wall, but the hand has not yet reached it (%.2f "
        "N/mm)",
        k * 1e-3);
  }
  return formatted("contact: wall stiffness %.2f N/mm", k * 1e-3);
}

std::string engaging(const ConsoleSnapshot& s) {
  if (s.view.refusal != HoldCause::kNone)
    return "engaging, but not yet accepted: " + refusal_in_words(s.view);
  if (!s.view.answer_in_s || !s.link.rtt_s) return "engaging: waiting for the slave's response";
  if (*s.view.answer_in_s < 0.05)
    return formatted("engaging: the slave's response is due (round trip %.2f s)", *s.link.rtt_s);
  return formatted("engaging: the slave's response is due in %.1f s (round trip %.2f s)", *s.view.answer_in_s,
                   *s.link.rtt_s);
}

std::string following(const ConsoleSnapshot& s) {
  if (s.view.clutched) return "clutch: the hand moves freely, the robot stays in place";
  const std::string limit = held_back(s.view);
  if (s.view.in_contact) return touching(s) + (limit.empty() ? "" : "; " + limit) + as_of(s);
  if (!limit.empty()) return limit + as_of(s);
  if (turned_against(s.view)) {
    return formatted("remembered stop of %.3g N m/rad; the robot is not touching it",
                     s.view.rotational_stiffness_nm_per_rad) +
           as_of(s);
  }
  if (s.view.spring_force_n.norm() > 0.0) {
    return formatted("remembered wall of %.2f N/mm; the robot is not touching it",
                     s.view.stiffness_n_per_m * 1e-3) +
           as_of(s);
  }
  const bool rate = s.view.mode == MotionMode::kRate;
  return (rate ? "free motion: the deflection of the hand sets the speed of the robot"
               : formatted("free motion: the robot follows the hand, scaled by %.2f", s.view.scale)) +
         (s.turns ? "" : "; its orientation is constant, because this handle does not turn") + as_of(s);
}

std::string holding(const ConsoleSnapshot& s) {
  const MasterView& view = s.view;
  if (view.cause == HoldCause::kNone || (view.cause == HoldCause::kHandleLetGo && !view.hand_missing))
    return "holding: engage to resume";
  const std::string begin = "holding: " + cause_in_words(view);
  if (view.cause == HoldCause::kLinkSilent && !view.cause_is_far) {
    if (view.silent)
      return formatted("holding: nothing received from the slave for %.1f s", s.link.silence_s) +
             (view.resumes ? "" : "; engage when the link has recovered");
    return formatted("holding: nothing was received from the slave for %.1f s; the link has recovered: ",
                     view.hold_silence_s) +
           (view.resumes ? "the robot resumes automatically" : "engage to resume");
  }
  if (view.resumes) return begin + "; the robot resumes automatically if this ends soon";
  if (view.cause == HoldCause::kDelayRose && !view.cause_is_far && view.rtt_s && view.rtt_least_s)
    return formatted("holding: the round trip rose from %.2f to %.2f s; engage to accept the new delay",
                     *view.rtt_least_s, *view.rtt_s);
  return begin + "; " + std::string(remedy(view.cause));
}

std::string observing(const ConsoleSnapshot& s) {
  if (s.view.silent)
    return formatted(
        "observing: nothing received from the slave for %.1f s; engage when the link has recovered",
        s.link.silence_s);
  if (s.view.hand_missing) return "observing: the robot is at rest; grasp the handle to engage";
  if (s.view.refusal != HoldCause::kNone) return "observing: not engaged: " + refusal_in_words(s.view);
  if (s.view.far_state == SafetyState::kFault) {
    const std::string why = s.view.far_known ? sentence(s.view.far.cause) : "";
    return "observing: the slave reports a fault" + (why.empty() ? "" : ": " + why) +
           "; engage after the fault has been cleared";
  }
  if (s.view.cause != HoldCause::kNone)
    return "observing: " + cause_in_words(s.view) + "; " + std::string(remedy(s.view.cause));
  return "observing: the robot is at rest; engage to take control";
}

}  // namespace

std::string_view state_in_words(SafetyState state) {
  static constexpr std::array<std::string_view, 6> kNames = {"Idle",    "Observing", "Engaged",
                                                             "Holding", "Stopped",   "Fault"};
  return name_of(state, kNames);
}

std::string cause_in_words(const MasterView& view) {
  if (view.cause == HoldCause::kLinkSilent && !view.cause_is_far && !view.silent)
    return "no datagrams arrived from the other side";
  if (!view.cause_is_far) return sentence(view.cause);
  const bool lasts = view.far_state == SafetyState::kHolding || view.far_state == SafetyState::kStopped ||
                     view.far_state == SafetyState::kFault || view.state == SafetyState::kObserving;
  return (lasts ? "at the slave: " : "at the slave (now over): ") + sentence(view.cause);
}

std::string refusal_in_words(const MasterView& view) {
  if (view.refusal == HoldCause::kUnanswered && view.far_state == SafetyState::kIdle)
    return "the slave does not receive this master's datagrams; check the link in that direction, then "
           "engage again";
  return (view.refusal_is_far ? "at the slave: " : "") + with_remedy(view.refusal);
}

std::optional<double> age_of_news_s(const ConsoleSnapshot& s) {
  if (!s.view.far_known || !s.link.rtt_s) return std::nullopt;
  return s.view.far_age_s + 0.5 * *s.link.rtt_s;
}

std::string_view mode_in_words(MotionMode mode) { return mode == MotionMode::kRate ? "rate" : "position"; }

std::string moved_out_in_words(const MasterView& view) {
  constexpr double kShown_m = 1e-3;
  if (!(view.moved_out_m > kShown_m)) return "";
  return formatted("goal: moved out by %.0f mm", 1e3 * view.moved_out_m);
}

std::vector<std::string> clamps_in_words(const MasterView& view) {
  std::vector<std::string> words;
  if (view.force_clamped) words.emplace_back("hand force: at its limit");
  if (view.stiffness_clamped)
    words.push_back(formatted("stiffness: limited to %.3g N/mm, the maximum that this device can render",
                              1e-3 * view.stiffness_max_n_per_m));
  if (view.rotational_stiffness_clamped)
    words.push_back(
        formatted("rotational stiffness: limited to %.3g N m/rad, the maximum that this device can render",
                  view.rotational_stiffness_max_nm_per_rad));
  if (const std::string moved = moved_out_in_words(view); !moved.empty())
    words.push_back(moved + ", so that the robot presses as much as the hand feels");
  if (view.damping_injected) words.emplace_back("hand: damped so that no energy is returned");
  if (view.at_boundary)
    words.emplace_back("hand: at the edge of its workspace; move it back with the clutch");
  if (!view.far_known || view.silent) return words;  // the limits in the last telemetry are out of date
  const Clamps& robot = view.far.clamps;
  const bool late = behind(view.far);
  if (robot.tool_speed && view.approach_m_per_s > 0.0)
    words.push_back(
        formatted("robot: approach limited to %.0f mm/s: unknown space", 1e3 * view.approach_m_per_s));
  else if (robot.tool_speed && late)
    words.emplace_back("robot: the tool is at its speed limit");
  if (robot.joint_speed && late) words.emplace_back("robot: a joint is at its speed limit");
  if (const std::string end = boundary_in_words(robot, view.far.X_WE, view.far.X_WE_goal); !end.empty())
    words.push_back("robot: " + end);
  if (robot.workspace) words.emplace_back("robot: the goal is outside the workspace");
  if (robot.force_guard) words.emplace_back("robot: stopped by the force guard");
  if (robot.moment_guard) words.emplace_back("robot: stopped by the moment guard");
  if (robot.singularity && late) words.emplace_back("robot: slowed down near a singular pose");
  if (view.far.limit_violations > 0)
    words.push_back(formatted("robot: %.0f setpoints exceeded a limit; `longreach status` names it",
                              static_cast<double>(view.far.limit_violations)));
  return words;
}

std::string happening(const ConsoleSnapshot& s) {
  if (!s.trouble.empty()) return s.trouble;
  if (!heard(s)) return "waiting for the first datagram from the slave";
  switch (s.view.state) {
    case SafetyState::kIdle:
    case SafetyState::kObserving:
      return s.view.engaging && !s.view.silent ? engaging(s) : observing(s);
    case SafetyState::kEngaged:
      return following(s);
    case SafetyState::kHolding:
      return holding(s);
    case SafetyState::kStopped:
    case SafetyState::kFault: {
      const std::string words = s.view.state == SafetyState::kStopped ? "stopped: " : "fault: ";
      if (s.view.refusal != HoldCause::kNone) return words + "not engaged: " + refusal_in_words(s.view);
      return words + cause_in_words(s.view) + "; " + std::string(remedy(s.view.cause));
    }
  }
  return "unknown state";
}

}  // namespace longreach
