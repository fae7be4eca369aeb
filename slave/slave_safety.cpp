#include "slave/slave_safety.hpp"

#include <algorithm>

namespace longreach {

bool SlaveSafety::step(const SlaveSafetyInput& in) {
  observe_session(in);
  if (in.commanded) {
    request_ = in.request;
    requested_ = in.engagement;
    if (in.echo_sent) echo_sent_ = in.echo_sent;
  }
  if (!in.robot_ok) {
    leave(SafetyState::kFault, HoldCause::kRobotFault, in.now);
    return false;
  }
  const bool stop_asked = in.stop || (in.commanded && in.request == Request::kStop);
  if (stop_asked) {
    if (in.commanded) used_ = std::max(used_, in.engagement);
    if (state_ != SafetyState::kFault) leave(SafetyState::kStopped, HoldCause::kOperator, in.now);
    return false;
  }
  if (accepts(in)) {
    state_ = SafetyState::kEngaged;
    cause_ = HoldCause::kNone;
    engagement_ = used_ = in.engagement;
    restarted_ = false;
    return true;
  }
  switch (state_) {
    case SafetyState::kIdle:
      if (in.last_heard && to_seconds(in.now - *in.last_heard) <= config_.gap_s)
        state_ = SafetyState::kObserving;
      break;
    case SafetyState::kObserving:
      if (!in.last_heard || to_seconds(in.now - *in.last_heard) > config_.gap_s + config_.resume_s) {
        state_ = SafetyState::kIdle;
      }
      break;
    case SafetyState::kEngaged:
      if (const HoldCause cause = demand(in); cause != HoldCause::kNone) {
        leave(SafetyState::kHolding, cause, in.now);
      }
      break;
    case SafetyState::kHolding:
      resume(in);
      break;
    case SafetyState::kStopped:
    case SafetyState::kFault:
      break;
  }
  return false;
}

void SlaveSafety::observe_session(const SlaveSafetyInput& in) {
  if (in.peer_session_count == sessions_) return;
  restarted_ = sessions_ != 0;
  sessions_ = in.peer_session_count;
  used_ = 0;
  requested_ = 0;
  request_ = Request::kHold;
  echo_sent_.reset();
}

bool SlaveSafety::accepts(const SlaveSafetyInput& in) const {
  if (!in.commanded || in.request != Request::kEngage || in.engagement <= used_ || !in.echo_sent)
    return false;
  const bool fresh = in.last_heard && to_seconds(in.now - *in.last_heard) <= config_.gap_s;
  return fresh && to_seconds(in.now - *in.echo_sent) <= config_.age_max_s;
}

// Why following must end; kNone: it need not.
HoldCause SlaveSafety::demand(const SlaveSafetyInput& in) const {
  if (restarted_) return HoldCause::kPeerRestarted;
  if (!in.last_heard || to_seconds(in.now - *in.last_heard) > config_.gap_s) return HoldCause::kLinkSilent;
  if (!echo_sent_ || to_seconds(in.now - *echo_sent_) > config_.age_max_s) return HoldCause::kLinkStale;
  if (request_ != Request::kEngage || requested_ != engagement_) return HoldCause::kOperator;
  return HoldCause::kNone;
}

void SlaveSafety::resume(const SlaveSafetyInput& in) {
  const HoldCause cause = demand(in);
  const bool late = to_seconds(in.now - left_at_) > config_.resume_s;
  if (cause_ != HoldCause::kLinkSilent || late ||
      (cause != HoldCause::kNone && cause != HoldCause::kLinkSilent)) {
    expired_ = true;
  }
  if (expired_ || cause != HoldCause::kNone) return;
  state_ = SafetyState::kEngaged;
  cause_ = HoldCause::kNone;
  ++false_holds_;
}

void SlaveSafety::leave(SafetyState state, HoldCause cause, Time now) {
  if (state_ == SafetyState::kEngaged || cause_ == HoldCause::kNone) {
    cause_ = cause;
    left_at_ = now;
    expired_ = false;
  }
  state_ = state;
}

}  // namespace longreach
