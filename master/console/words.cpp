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

/// Returns whether the robot lags visibly. A limit that causes a smaller lag does not deserve a warning.
bool behind(const Telemetry& robot) {
  constexpr double kBehind_m = 0.01;
  return (robot.X_WE_goal.p - robot.X_WE.p).norm() > kBehind_m;
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
  const std::string load =
      load_limit_in_words(view.far.load_acceleration_m_per_s2, view.far.load_acceleration_rad_per_s2);
  if (!load.empty()) words.push_back("robot: " + load);
  if (robot.workspace) words.emplace_back("robot: the goal is outside the workspace");
  if (robot.force_guard) words.emplace_back("robot: stopped by the force guard");
  if (robot.moment_guard) words.emplace_back("robot: stopped by the moment guard");
  if (robot.singularity && late) words.emplace_back("robot: slowed down near a singular pose");
  if (view.far.limit_violations > 0)
    words.push_back(formatted("robot: %.0f setpoints exceeded a limit; `longreach status` names it",
                              static_cast<double>(view.far.limit_violations)));
  return words;
}

}  // namespace longreach
