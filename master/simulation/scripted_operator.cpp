#include "master/simulation/scripted_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "master/simulation/hand_model.hpp"

namespace longreach {
namespace {

constexpr double kFelt_n = 0.5;       // contact force that a person notices
constexpr double kBackOff_m = 0.002;  // distance of the handle in front of the surface
constexpr double kReleased_m = 0.010;
constexpr double kFast_m_per_s = 0.02;      // unhurried motion of the hand
constexpr double kCareful_m_per_s = 0.008;  // towards a surface that will be touched
constexpr double kCoarse_m_per_s = 0.08;    // speed of the slave in rate mode
constexpr double kRest_s = 2.0;
constexpr double kStop_n = 8.0;         // a person does not push harder against the end of the workspace
constexpr double kRelocated_m = 0.005;  // distance of the handle from home at which the clutch is released
constexpr double kRelocates_s = 3.0;    // maximum duration of relocating
constexpr double kHome_m = 1e-4;        // distance from home along the direction
constexpr double kComesHome_s = 0.8;

/// Returns the direction in which the hand moves in a phase: 1 towards the surface, -1 away from it.
double direction_of(ScriptPhase phase) {
  switch (phase) {
    case ScriptPhase::kApproach:
    case ScriptPhase::kReturn:
      return 1.0;
    case ScriptPhase::kRetreat:
    case ScriptPhase::kRelease:
      return -1.0;
    default:
      return 0.0;
  }
}

}  // namespace

std::string_view to_string(ScriptPhase phase) {
  constexpr std::array<std::string_view, 12> kNames = {"waiting", "coarse",  "settle",  "approach",
                                                       "react",   "retreat", "pause",   "return",
                                                       "press",   "probe",   "release", "rest"};
  return kNames[static_cast<std::size_t>(phase)];
}

ScriptedOperator::ScriptedOperator(const OperatorConfig& config, const MappingConfig& mapping, Grip grip)
    : config_(config),
      mapping_(mapping),
      grip_(grip),
      direction_(config.direction.stableNormalized()),
      goal_direction_(exp_rotation(mapping.base_rotation_rad) * direction_),
      hand_stiffness_(std::max(hand_model(grip).stiffness_n_per_m, 1.0)) {}

void ScriptedOperator::enter(ScriptPhase phase, Time now) {
  phase_ = phase;
  entered_ = now;
}

ScriptOutput ScriptedOperator::step(const ScriptInput& input) {
  const double dt_s = started_ ? std::clamp(to_seconds(input.now - now_), 0.0, 0.05) : 0.0;
  if (!started_) entered_ = input.now;
  started_ = true;
  now_ = input.now;
  if (input.engagement != engagement_) covered_m_ += goal_m_;
  engagement_ = input.engagement;
  goal_m_ = goal_direction_.dot(input.goal_m);
  ScriptOutput out;
  if (!input.engaged && phase_ != ScriptPhase::kWaiting) enter(ScriptPhase::kWaiting, input.now);
  out.mode = decide(input);
  const double before_m = reach_m_;
  out.target.buttons.clutch = relocates(input);
  if (relocating_) {
    reach_m_ -= dt_s * std::clamp(8.0 * reach_m_, -0.1, 0.1);
  } else {
    move(input, dt_s);
  }
  speed_m_per_s_ = dt_s > 0.0 ? (reach_m_ - before_m) / dt_s : 0.0;
  out.target.position_m = reach_m_ * direction_;
  out.target.velocity_m_per_s = speed_m_per_s_ * direction_;
  out.target.grip = grip_;
  return out;
}

/// Changes the phase. Returns the mode to which the operator switches, if any.
std::optional<MotionMode> ScriptedOperator::decide(const ScriptInput& in) {
  const double elapsed_s = to_seconds(in.now - entered_);
  const double left_m = this->left_m(in);
  switch (phase_) {
    case ScriptPhase::kWaiting:
      if (!in.engaged) break;
      if (left_m > 0.0) {
        // After a hold the operator first lets the handle return home. A centre of rate mode that was left where the
        // handle was moves home with it as far as friction permits.
        const double off_m = direction_.dot(in.handle_m);
        const bool home = std::abs(off_m) < kHome_m;
        if (!home && (elapsed_s < kComesHome_s || std::abs(off_m) > mapping_.dead_zone_m)) break;
        centre_m_ = home || mapping_.rate_centre == RateCentre::kHandleOrigin ? 0.0 : off_m;
        enter(ScriptPhase::kCoarse, in.now);
        return MotionMode::kRate;
      }
      enter(in.surface_known ? ScriptPhase::kReturn : ScriptPhase::kApproach, in.now);
      return MotionMode::kPosition;
    case ScriptPhase::kCoarse:
      // Contact with a wall also ends this phase.
      if (left_m < 5e-4 || in.felt_n > kFelt_n) enter(ScriptPhase::kSettle, in.now);
      break;
    case ScriptPhase::kSettle:
      if (elapsed_s < 0.4 || std::abs(direction_.dot(in.handle_m)) > mapping_.dead_zone_m) break;
      enter(ScriptPhase::kApproach, in.now);
      return MotionMode::kPosition;
    case ScriptPhase::kApproach:
      if (in.felt_n > kFelt_n) enter(ScriptPhase::kReact, in.now);
      break;
    case ScriptPhase::kReact:
      if (elapsed_s > config_.reaction_s) enter(ScriptPhase::kRetreat, in.now);
      break;
    case ScriptPhase::kRetreat:
      if (in.depth_m < -kBackOff_m) enter(ScriptPhase::kPause, in.now);
      break;
    case ScriptPhase::kPause:
      if (elapsed_s > config_.reaction_s) enter(ScriptPhase::kReturn, in.now);
      break;
    case ScriptPhase::kReturn:
      if (in.felt_n > kFelt_n) enter(ScriptPhase::kPress, in.now);
      break;
    case ScriptPhase::kPress:
      if (elapsed_s < 1.5) break;
      probe_centre_m_ = reach_m_;
      enter(ScriptPhase::kProbe, in.now);
      break;
    case ScriptPhase::kProbe:
      if (elapsed_s < config_.probe_cycles / config_.probe_hz) break;
      ++cycles_;
      enter(ScriptPhase::kRelease, in.now);
      break;
    case ScriptPhase::kRelease:
      if (in.depth_m < -kReleased_m || elapsed_s > 3.0) enter(ScriptPhase::kRest, in.now);
      break;
    case ScriptPhase::kRest:
      if (elapsed_s > kRest_s) enter(ScriptPhase::kReturn, in.now);
      break;
  }
  return std::nullopt;
}

double ScriptedOperator::left_m(const ScriptInput& in) const {
  return config_.rate_distance_m - covered_m_ - goal_direction_.dot(in.goal_m);
}

double ScriptedOperator::coarse_deflection(double left_m) const {
  const double speed = std::min(kCoarse_m_per_s, 2.0 * left_m);
  return mapping_.dead_zone_m + speed / mapping_.kv_per_s;
}

/// At the end of the workspace in position mode: presses the clutch, moves the handle home and releases the
/// clutch.
bool ScriptedOperator::relocates(const ScriptInput& in) {
  const double way = direction_of(phase_), handle_m = direction_.dot(in.handle_m);
  const bool blocked = way != 0.0 && !(way > 0.0 && in.felt_n > kFelt_n) &&
                       way * (reach_m_ - handle_m) > 0.95 * kStop_n / hand_stiffness_;
  if (relocating_) {
    const double elapsed_s = to_seconds(in.now - blocked_);
    relocating_ = in.engaged && way != 0.0 && std::abs(handle_m) > kRelocated_m && elapsed_s < kRelocates_s;
    if (!relocating_) blocked_ = in.now;
    return relocating_;
  }
  if (!blocked) blocked_ = in.now;
  relocating_ = to_seconds(in.now - blocked_) > config_.reaction_s;
  if (relocating_) blocked_ = in.now;
  return relocating_;
}

/// Moves the target of the hand along the direction.
void ScriptedOperator::move(const ScriptInput& in, double dt_s) {
  const double handle_m = direction_.dot(in.handle_m);
  const double approach = std::min(config_.approach_speed_m_per_s / in.scale, kCareful_m_per_s);
  double speed = 0.0;
  switch (phase_) {
    case ScriptPhase::kCoarse: {
      const double left_m = this->left_m(in);
      speed = in.bring_home ? -8.0 * reach_m_ : 8.0 * (centre_m_ + coarse_deflection(left_m) - handle_m);
      break;
    }
    case ScriptPhase::kWaiting:
    case ScriptPhase::kSettle:
      speed = -8.0 * reach_m_;
      break;
    case ScriptPhase::kApproach:
    case ScriptPhase::kReact:
      speed = approach;
      break;
    case ScriptPhase::kReturn:
      speed = std::min(2.0 * approach, kFast_m_per_s);
      break;
    case ScriptPhase::kRetreat:
    case ScriptPhase::kRelease:
      speed = -kFast_m_per_s;
      break;
    case ScriptPhase::kPress:
      speed = 3.0 * (config_.press_n - in.felt_n) / hand_stiffness_;
      break;
    case ScriptPhase::kProbe: {
      const double angle = 2.0 * std::numbers::pi * config_.probe_hz * to_seconds(in.now - entered_);
      reach_m_ = probe_centre_m_ + config_.probe_n / hand_stiffness_ * std::sin(angle);
      return;
    }
    case ScriptPhase::kPause:
    case ScriptPhase::kRest:
      break;
  }
  reach_m_ += dt_s * std::clamp(speed, -0.1, 0.1);
  // A small device may not reach the deflection for the maximum speed.
  if (phase_ == ScriptPhase::kCoarse || direction_of(phase_) != 0.0) {
    const double stop_m = kStop_n / hand_stiffness_;
    reach_m_ = std::clamp(reach_m_, handle_m - stop_m, handle_m + stop_m);
  }
}

}  // namespace longreach
