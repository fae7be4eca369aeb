#include "master/input/axis_hand.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kStepMax_s = 0.1;  // avoids a jump after a stall

/// Returns the deflection beyond the dead zone, with magnitude at most 1; zero if it is not finite.
Vector3 shaped(const Vector3& d, double dead_zone) {
  const double length = d.allFinite() ? norm(d) : 0.0;
  if (length <= dead_zone) return Vector3::Zero();
  return std::min((length - dead_zone) / (1.0 - dead_zone), 1.0) / length * d;
}

bool has(std::uint32_t buttons, PadButton button) {
  return (buttons >> static_cast<unsigned>(button) & 1U) != 0;
}

}  // namespace

AxisHandConfig axis_hand_config(const OperatorConfig& config, const DeviceConfig& device) {
  return {.dead_zone = config.dead_zone,
          .reach_m = config.reach_m,
          .reach_rad = config.reach_rad,
          .speed_m_per_s = config.speed_m_per_s,
          .speed_rad_per_s = config.speed_rad_per_s,
          .workspace_m = device.delta.workspace_m,
          .workspace_rad = device.spherical.workspace_rad,
          .silence_at_stop_s = config.kind == OperatorKind::kSpacemouse ? 0.3 : 1.0};
}

const AxisHandState& AxisHand::step(const AxisSample& sample, MotionMode mode, double dt_s) {
  state_.requests = {};
  state_.level.present = sample.present;
  if (!sample.present) {
    state_.level.target_m.setZero();
    state_.level.target_rad.setZero();
    state_.level.clutch = false;
    state_.armed = state_.silent = false;
    buttons_ = {};
    return state_;
  }
  move(sample, mode, dt_s);
  take_buttons(sample.buttons, mode, dt_s);
  return state_;
}

bool AxisHand::silent(const AxisSample& sample, double dt_s) {
  quiet_s_ = sample.reports != reports_ ? 0.0 : quiet_s_ + std::max(dt_s, 0.0);
  reports_ = sample.reports;
  const bool at_stop = std::max(sample.push.cwiseAbs().maxCoeff(), sample.twist.cwiseAbs().maxCoeff()) >= 1.0;
  return quiet_s_ > (at_stop ? config_.silence_at_stop_s : config_.silence_s);
}

void AxisHand::move(const AxisSample& sample, MotionMode mode, double dt_s) {
  Vector3 push = shaped(sample.push, config_.dead_zone);
  Vector3 twist = shaped(sample.twist, config_.dead_zone);
  const bool released = push.isZero(0.0) && twist.isZero(0.0);
  state_.armed = state_.armed || released;
  state_.silent = silent(sample, dt_s) && !released;
  if (state_.silent) {
    push.setZero();
    twist.setZero();
  }
  if (!state_.armed) return;
  HandLevel& level = state_.level;
  if (mode == MotionMode::kRate) {
    level.target_m = config_.reach_m * push;
    level.target_rad = config_.reach_rad * twist;
  } else {
    const double t = std::clamp(dt_s, 0.0, kStepMax_s);
    level.target_m += t * config_.speed_m_per_s * push;
    level.target_rad += t * config_.speed_rad_per_s * twist;
  }
  level.target_m = clamp_norm(level.target_m, config_.workspace_m);
  level.target_rad = clamp_norm(level.target_rad, config_.workspace_rad);
}

void AxisHand::take_buttons(std::uint32_t buttons, MotionMode mode, double dt_s) {
  std::uint32_t pressed = 0;
  for (std::size_t i = 0; i < buttons_.size(); ++i)
    if (buttons_[i].step(has(buttons, static_cast<PadButton>(i)), dt_s)) pressed |= 1U << i;
  OperatorRequests& r = state_.requests;
  state_.level.clutch = has(buttons, PadButton::kClutch);
  if (has(pressed, PadButton::kHome)) {
    state_.level.target_m.setZero();
    state_.level.target_rad.setZero();
  }
  if (has(pressed, PadButton::kMode))
    r.mode = mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
  r.scale_steps = has(pressed, PadButton::kScaleUp) - has(pressed, PadButton::kScaleDown);
  r.kv_steps = has(pressed, PadButton::kKvUp) - has(pressed, PadButton::kKvDown);
  r.turns_gripper = has(pressed, PadButton::kGripper);
  // A stop takes precedence.
  r.stop = has(pressed, PadButton::kStop);
  r.engage = has(pressed, PadButton::kEngage) && !r.stop;
}

}  // namespace longreach
