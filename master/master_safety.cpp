#include "master/master_safety.hpp"

#include <algorithm>

namespace longreach {

void MasterSafety::on_report(const StiffnessReport& report) {
  far_state_ = report.state;
  far_cause_ = report.cause;
  far_engagement_ = report.engagement;
}

void MasterSafety::leave(SafetyState state, HoldCause cause, Time now) {
  if (state_ == SafetyState::kEngaged || state_ == SafetyState::kObserving) {
    cause_ = cause;
    left_at_ = now;
  }
  state_ = state;
}

bool MasterSafety::step(const MasterSafetyInput& in) {
  const bool heard = in.last_heard.has_value();
  stale_ = heard && to_seconds(in.now - *in.last_heard) > config_.silence_s;
  const bool restarted = in.peer_restarts != peer_restarts_;
  peer_restarts_ = in.peer_restarts;
  if (restarted) {
    far_state_ = SafetyState::kObserving;
    far_engagement_ = 0;
  }
  if (state_ == SafetyState::kIdle && heard) state_ = SafetyState::kObserving;

  bool engage = in.engage;
  if (config_.engage_at_start && !engaged_once_ && heard && !stale_) engage = true;

  // The most severe demand first.
  if (!in.device_ok) {
    if (state_ != SafetyState::kFault) leave(SafetyState::kFault, HoldCause::kDeviceFault, in.now);
    request_ = Request::kHold;
    return false;
  }
  if (in.stop) {
    leave(SafetyState::kStopped, HoldCause::kOperator, in.now);
    request_ = Request::kStop;
    return false;
  }
  if (engage && heard && !stale_) {
    engagement_ =
        std::max(engagement_, far_engagement_) + 1;  // the slave may remember another master's numbers
    engaged_once_ = true;
    confirmed_ = false;
    state_ = SafetyState::kObserving;
    cause_ = HoldCause::kNone;
    request_ = Request::kEngage;
    return false;
  }
  const bool active = state_ == SafetyState::kEngaged || state_ == SafetyState::kHolding ||
                      (state_ == SafetyState::kObserving && request_ == Request::kEngage);
  if (active && restarted) {
    leave(SafetyState::kHolding, HoldCause::kPeerRestarted, in.now);
    request_ = Request::kHold;
    return false;
  }
  if (active && in.hold) {
    leave(SafetyState::kHolding, HoldCause::kOperator, in.now);
    request_ = Request::kHold;
    return false;
  }
  if (active && stale_) {
    if (state_ != SafetyState::kHolding) leave(SafetyState::kHolding, HoldCause::kLinkSilent, in.now);
    if (to_seconds(in.now - left_at_) > config_.resume_s) request_ = Request::kHold;
    return false;
  }
  if (!active || request_ != Request::kEngage || far_engagement_ != engagement_) return false;
  const SafetyState before = state_;
  follow_slave(in.now);
  const bool begun = state_ == SafetyState::kEngaged && !confirmed_;
  if (begun) confirmed_ = true;
  if (before == SafetyState::kHolding && state_ == SafetyState::kEngaged) ++false_holds_;
  return begun;
}

/// The slave's word on the present engagement decides, as long as the link lives.
void MasterSafety::follow_slave(Time now) {
  switch (far_state_) {
    case SafetyState::kEngaged:
      state_ = SafetyState::kEngaged;
      cause_ = HoldCause::kNone;
      break;
    case SafetyState::kHolding:
      if (state_ == SafetyState::kEngaged) leave(SafetyState::kHolding, HoldCause::kPeerHolds, now);
      break;
    case SafetyState::kStopped:
      leave(SafetyState::kStopped, HoldCause::kPeerHolds, now);
      request_ = Request::kHold;
      break;
    case SafetyState::kFault:
      leave(SafetyState::kHolding, HoldCause::kRobotFault, now);
      request_ = Request::kHold;
      break;
    case SafetyState::kIdle:
    case SafetyState::kObserving:
      break;
  }
}

}  // namespace longreach
