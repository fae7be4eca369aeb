#include "master/program/master_shell.hpp"

#include <utility>

#include "master/input/pad_operator.hpp"
#include "master/simulation/hand_model.hpp"

namespace longreach {
namespace {

constexpr double kHandSpeed_m_per_s = 0.1;  // a key requests a step, whereas a hand moves continuously
constexpr double kHandSpeed_rad_per_s = 1.0;
constexpr double kHomeSpeed_m_per_s = 0.05;

/// Returns whether the handle is still away from its target or moving. The thresholds exceed what friction
/// leaves, and are slightly smaller than the dead zones of rate mode.
bool away(const HandLevel& level, const HandleState& handle, bool turns) {
  constexpr double kFar_m = 0.004, kFar_rad = 0.04, kMoves_m_per_s = 0.01, kMoves_rad_per_s = 0.1;
  return norm(level.target_m - handle.p_MH) > kFar_m ||
         (turns && norm(level.target_rad - log_rotation(handle.q_MH)) > kFar_rad) ||
         norm(handle.velocity_m_per_s) > kMoves_m_per_s || norm(handle.angular_rad_per_s) > kMoves_rad_per_s;
}

}  // namespace

MasterShell::MasterShell(const MasterConfig& config, std::uint64_t seed, std::uint32_t reduced)
    : SideShell(config, config.link.slave, Random(seed).child("down"), reduced),
      config_(config),
      devices_(config.device),
      device_(adapter_ ? static_cast<HapticDevice&>(*adapter_) : devices_),
      script_(config.operator_, config.mapping, config.hand.grip),
      script_grip_(config.hand.grip),
      lost_(PadOperator::is_for(config.operator_.kind)),
      remote_(1.0 / config.loop.rate_hz) {}

void MasterShell::tick(Time now, const LoopFigures& loop) {
  OperatorRequests requests;
  const bool stop = stops_.take();
  if (const MasterCommand* command = mailbox_.take()) mailbox_.answer(obey(*command, now, requests));

  const HandleState& handle = side_.read(now, device_);
  HandTarget target = operate(now, handle, requests);
  brace(target);
  if (!config_.device.turns) target.rotation_rad.setZero();
  devices_.set_target(target);
  requests.stop = stop || requests.stop;
  // Without keyboard or pad the simulated device counts as failed.
  side_.step(device_, loop, {.requests = requests, .hand_stale = hand_stale_, .lost = lost_});
  snapshot_.phase = script_.phase();
  snapshot_.hand_outside = remote_.holds();
  snapshot_.hand_lost = lost_;
  snapshot_.hand_begin = begin_;
  publish();
}

LoopAnswer MasterShell::obey(const MasterCommand& command, Time now, OperatorRequests& requests) {
  if (const auto* asked = std::get_if<OperatorRequests>(&command)) {
    requests = *asked;
  } else if (const auto* session = std::get_if<Session>(&command)) {
    side_.follow(*session);
  } else if (std::holds_alternative<MasterPreempted>(command)) {
    side_.preempt();
  } else {
    const auto* change = std::get_if<MasterChange>(&command);
    const LoopAnswer answer = obey_common(command, now);
    if (change == nullptr || answer != LoopAnswer::kDone) return answer;
    config_ = change->config;
    if (change->script) {
      script_ = ScriptedOperator(config_.operator_, config_.mapping, config_.hand.grip);
      script_grip_ = config_.hand.grip;
    }
  }
  return LoopAnswer::kDone;
}

HandTarget MasterShell::operate(Time now, const HandleState& handle, OperatorRequests& requests) {
  hand_stale_ = false;
  const OperatorKind kind = config_.operator_.kind;
  const bool person = kind == OperatorKind::kKeyboard || PadOperator::is_for(kind);
  const std::uint32_t engagement = side_.node().view().engagement;
  const RemoteHandInput remote{now, remote_aim_.read(), handle, engagement, config_.hand.grip, person};
  const auto aimed = adapter_ ? std::nullopt : remote_.step(remote, requests);
  const std::uint64_t holder = remote_.holds() ? remote.aim.hand : 0;
  if (holder != holder_ || engagement != engagement_) begin_hand(handle);
  holder_ = holder;
  engagement_ = engagement;
  // A remote hand takes precedence over the configured operator of the simulated handle.
  if (aimed) {
    lost_ = false;
    hand_stale_ = remote_.fell_silent();
    restart_script();
    return *aimed;
  }
  if (person) {
    const HandLevel& level = hand_.read();
    hand_stale_ = to_seconds(now - level.said) > kHandAgeMax_s;
    if (!level.present || hand_stale_) begin_hand(handle);
    // After a reconnection the hand counts again only when the handle has reached its target. Otherwise the
    // robot would move by the remaining deflection.
    const bool far = level.change != begin_.change || away(level, handle, config_.device.turns);
    lost_ = !adapter_ && (!level.present || (lost_ && far));
    requests.clutch = level.clutch;
    return hold(level);
  }
  if (kind == OperatorKind::kNone || adapter_) {
    HandTarget no_hand;
    no_hand.grip = Grip::kReleased;
    return no_hand;
  }
  const MasterView& view = side_.node().view();
  const ScriptOutput script = script_.step({.now = now,
                                            .handle_m = handle.p_MH - script_from_m_,
                                            .felt_n = view.spring_force_n.norm(),
                                            .goal_m = view.goal_m,
                                            .scale = view.scale,
                                            .engaged = view.state == SafetyState::kEngaged,
                                            .engagement = view.engagement,
                                            .surface_known = view.surface_known,
                                            .depth_m = view.inward.dot(handle.p_MH) - view.surface_m,
                                            .bring_home = view.bring_home});
  if (script.mode && !requests.mode) requests.mode = script.mode;
  HandTarget target = script.target;
  if (std::exchange(script_displaced_, false)) script_from_m_ = handle.p_MH - target.position_m;
  if (view.bring_home)
    script_from_m_ -= clamp_norm(script_from_m_, kHomeSpeed_m_per_s / config_.loop.rate_hz);
  target.position_m += script_from_m_;
  // The configured grip may change while the script runs. If the script itself releases the handle, it stays
  // released.
  if (target.grip == script_grip_) target.grip = config_.hand.grip;
  return target;
}

/// Makes the script resume from where a remote hand leaves the handle.
void MasterShell::restart_script() {
  script_displaced_ = true;
  if (script_.phase() == ScriptPhase::kWaiting) return;
  script_ = ScriptedOperator(config_.operator_, config_.mapping, config_.hand.grip);
  script_grip_ = config_.hand.grip;
}

/// Lets a hand that begins in contact hold the handle where it is.
void MasterShell::brace(HandTarget& target) {
  const MasterView& view = side_.node().view();
  target.position_m +=
      brace_m_.step(target.position_m, view.spring_force_n, hand_model(target.grip).stiffness_n_per_m);
  target.rotation_rad += brace_rad_.step(target.rotation_rad, view.spring_moment_nm,
                                         wrist_model(target.grip).stiffness_nm_per_rad);
}

/// Makes the hand at keyboard or pad begin where the handle is.
void MasterShell::begin_hand(const HandleState& handle) {
  begin_ = {begin_.change + 1, handle.p_MH, log_rotation(handle.q_MH)};
  held_m_ = begin_.target_m;
  held_rad_ = begin_.target_rad;
  brace_m_.begin();
  brace_rad_.begin();
}

HandTarget MasterShell::hold(const HandLevel& level) {
  HandTarget target;
  if (!level.present || hand_stale_) {
    target.grip = Grip::kReleased;
    return target;
  }
  target.position_m = held_m_;
  target.rotation_rad = held_rad_;
  target.grip = config_.hand.grip;
  if (level.change != begin_.change) return target;  // it does not know yet where to begin
  const double period_s = 1.0 / config_.loop.rate_hz;
  const Vector3 step = clamp_norm(level.target_m - held_m_, kHandSpeed_m_per_s * period_s);
  held_m_ += step;
  held_rad_ += clamp_norm(level.target_rad - held_rad_, kHandSpeed_rad_per_s * period_s);
  target.position_m = held_m_;
  target.velocity_m_per_s = step / period_s;
  target.rotation_rad = held_rad_;
  return target;
}

}  // namespace longreach
