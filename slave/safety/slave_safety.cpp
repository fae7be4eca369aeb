#include "slave/safety/slave_safety.hpp"

#include <algorithm>
#include <limits>

#include "common/safety/ended_request.hpp"

namespace longreach {

enum class SlaveSafety::Demand : std::uint8_t {
  kRobotFault,
  kSensorFault,
  kSensorSign,
  kRobotUncommandedMotion,
  kRobotTrackingLost,
  kStop,
  kEngagement,
  kForcePersists,
  kTaken,
  kRestarted,
  kStalled,
  kSilent,
  kStale,
  kDelayRose,
  kOverrun,
  kHold,
  kLetGo,
  kGoOn,
  kReceived,
  kGone
};

namespace {

using State = SafetyState;
using Cause = HoldCause;

constexpr unsigned in(State state) { return 1U << static_cast<unsigned>(state); }
constexpr unsigned kAny = ~0U;
constexpr unsigned kMoved = in(State::kEngaged) | in(State::kHolding) | in(State::kStopped);
constexpr unsigned kAtRest = in(State::kHolding) | in(State::kStopped) | in(State::kFault);

}  // namespace

struct SlaveSafety::Rule {
  unsigned from;
  Demand demand;
  State to;
  HoldCause cause;
};

const SlaveSafety::Rule SlaveSafety::kTable[] = {
    {kAny, Demand::kRobotFault, State::kFault, Cause::kRobotFault},
    {kAny, Demand::kSensorFault, State::kFault, Cause::kSensorFault},
    {kMoved, Demand::kSensorSign, State::kFault, Cause::kSensorSign},
    {kAtRest, Demand::kRobotUncommandedMotion, State::kFault, Cause::kUncommandedMotion},
    {kMoved, Demand::kRobotTrackingLost, State::kFault, Cause::kTrackingLost},
    {kAny & ~in(State::kFault), Demand::kStop, State::kStopped, Cause::kOperator},
    {kAny, Demand::kEngagement, State::kEngaged, Cause::kNone},
    {in(State::kEngaged) | in(State::kHolding), Demand::kForcePersists, State::kHolding,
     Cause::kForcePersists},
    {in(State::kEngaged), Demand::kTaken, State::kHolding, Cause::kPreempted},
    {in(State::kEngaged), Demand::kRestarted, State::kHolding, Cause::kPeerRestarted},
    {in(State::kEngaged), Demand::kStalled, State::kHolding, Cause::kStalled},
    {in(State::kEngaged), Demand::kSilent, State::kHolding, Cause::kLinkSilent},
    {in(State::kEngaged), Demand::kStale, State::kHolding, Cause::kLinkStale},
    {in(State::kEngaged), Demand::kDelayRose, State::kHolding, Cause::kDelayRose},
    {in(State::kEngaged), Demand::kOverrun, State::kHolding, Cause::kOverrun},
    {in(State::kEngaged), Demand::kHold, State::kHolding, Cause::kPeerHolds},
    {in(State::kEngaged), Demand::kLetGo, State::kHolding, Cause::kHandleReleased},
    {in(State::kHolding), Demand::kGoOn, State::kEngaged, Cause::kNone},
    {in(State::kIdle), Demand::kReceived, State::kObserving, Cause::kNone},
    {in(State::kObserving), Demand::kGone, State::kIdle, Cause::kNone}};

bool SlaveSafety::step(const SlaveSafetyInput& input) {
  observe(input);
  const auto applies = [&](const Rule& rule) {
    return (rule.from & in(state_)) != 0 && demanded(rule.demand, input);
  };
  const Rule* rule = std::ranges::find_if(kTable, applies);
  // A stop also ends the engagement that is being requested, in every state, even if the request arrived in
  // an earlier tick.
  if (demanded(Demand::kStop, input))
    used_ = std::max({used_, requested_, input.commanded ? input.engagement : 0});
  const bool changes = rule != std::end(kTable);
  if (changes) enter(*rule, input);
  if (input.commanded) {
    refusal_ = asks(input) ? why_not(input) : Reason{};
    refused_ = refusal_ == Cause::kNone ? 0 : input.engagement;
    if (refused_ > used_ && ends_request(refusal_)) {
      used_ = ended_ = refused_;
      ended_because_ = refusal_;
    }
  }
  const double ahead_s = std::min(input.lag_s, 0.5 * gap_s(config_, input.send_hz));
  brakes_ = state_ == State::kEngaged && silent(input, -ahead_s);
  return changes && rule->demand == Demand::kEngagement;
}

bool SlaveSafety::demanded(Demand demand, const SlaveSafetyInput& in) const {
  switch (demand) {
    case Demand::kRobotFault:
      return in.robot != Cause::kNone;
    case Demand::kSensorFault:
      return in.sensor_fault;
    case Demand::kSensorSign:
      return in.sensor_sign;
    case Demand::kForcePersists:
      return in.force_persists;
    case Demand::kRobotUncommandedMotion:
      return in.robot_uncommanded_motion;
    case Demand::kRobotTrackingLost:
      return in.robot_tracking_lost;
    case Demand::kStop:
      return in.stop || (in.commanded && in.request == Request::kStop);
    case Demand::kEngagement:
      return asks(in) && in.engagement > used_ && why_not(in) == Cause::kNone;
    case Demand::kTaken:
      return taken_;
    case Demand::kRestarted:
      return restarted_;
    case Demand::kStalled:
      return in.stalled_since.has_value();
    case Demand::kSilent:
      return silent(in);
    case Demand::kDelayRose:
      return in.delay_rose;
    case Demand::kOverrun:
      return in.overrun;
    case Demand::kStale:
      return !echo_sent_ || to_seconds(in.now - *echo_sent_) > config_.age_max_s;
    case Demand::kHold:
      return requested_ != engagement_ || (request_ != Request::kEngage && request_ != Request::kLetGo);
    case Demand::kLetGo:
      return request_ == Request::kLetGo;
    case Demand::kGoOn:
      return goes_on(in);
    case Demand::kReceived:
      return !silent(in);
    case Demand::kGone:
      return silent(in, config_.resume_s);
  }
  return true;
}

// Stores the request of the master until the next one.
void SlaveSafety::observe(const SlaveSafetyInput& in) {
  if (in.peer_session_count != sessions_) {
    restarted_ = sessions_ != 0;
    taken_ = restarted_ && in.taken;
    sessions_ = in.peer_session_count;
    used_ = ended_ = 0;
    requested_ = 0;
    request_ = Request::kHold;
    echo_sent_.reset();
  }
  if (in.commanded && !in.stalled_since) {
    request_ = in.request;
    requested_ = in.engagement;
    if (in.echo_sent) echo_sent_ = in.echo_sent;
  }
  if (state_ == State::kHolding) expire(in);
}

bool SlaveSafety::silent(const SlaveSafetyInput& in, double longer_s) const {
  return !in.last_heard || to_seconds(in.now - *in.last_heard) > gap_s(config_, in.send_hz) + longer_s;
}

bool SlaveSafety::asks(const SlaveSafetyInput& in) { return in.commanded && in.request == Request::kEngage; }

// Returns why a requested engagement is not granted; kNone: it is the present one, or it may start. An
// engagement whose number is used up was stopped before it started.
Reason SlaveSafety::why_not(const SlaveSafetyInput& in) const {
  if (in.engagement <= used_) {
    if (in.engagement == engagement_) return {};
    if (in.engagement == ended_) return ended_because_;
    return cause_ == Cause::kNone ? Reason(Cause::kOperator) : cause_;
  }
  if (in.robot != Cause::kNone) return in.robot;
  if (in.sensor_fault) return Cause::kSensorFault;
  if (in.stop) return Cause::kOperator;
  if (in.robot_uncommanded_motion) return Cause::kUncommandedMotion;
  if (in.unready != Cause::kNone) return in.unready;
  if (in.stalled_since) return Cause::kStalled;
  if (silent(in)) return Cause::kLinkSilent;
  if (!in.echo_sent || to_seconds(in.now - *in.echo_sent) > config_.age_max_s) return Cause::kLinkStale;
  return {};
}

void SlaveSafety::expire(const SlaveSafetyInput& in) {
  const bool passing = cause_ == HoldCause::kLinkSilent || cause_ == HoldCause::kStalled ||
                       cause_ == HoldCause::kHandleReleased;
  const bool more = restarted_ || in.delay_rose || in.overrun || demanded(Demand::kStale, in) ||
                    demanded(Demand::kHold, in);
  if (!passing || more || to_seconds(in.now - left_at_) > config_.resume_s) expired_ = true;
}

void SlaveSafety::count_silence(const SlaveSafetyInput& in) {
  const auto& earliest = silences_.back();
  expired_ = earliest && to_seconds(in.now - *earliest) < kSilentHoldsWithin_s;
  if (expired_) cause_ = silent_repeatedly(gap_s(config_, in.send_hz));
  silences_ = {in.now, silences_.front()};
}

bool SlaveSafety::goes_on(const SlaveSafetyInput& in) const {
  return !expired_ && !in.stalled_since && !silent(in) && request_ == Request::kEngage;
}

void SlaveSafety::enter(const Rule& rule, const SlaveSafetyInput& in) {
  if (rule.to == State::kEngaged) {
    if (rule.demand == Demand::kEngagement) engagement_ = used_ = in.engagement, silences_ = {};
    if (rule.demand == Demand::kGoOn && cause_ == HoldCause::kLinkSilent) ++false_holds_;
    restarted_ = taken_ = false;
    cause_ = HoldCause::kNone;
  } else if (rule.to == State::kFault) {
    if (state_ != State::kFault) cause_ = rule.demand == Demand::kRobotFault ? in.robot : Reason(rule.cause);
  } else if (cause_ == HoldCause::kNone || rule.demand == Demand::kForcePersists) {
    const bool comes = rule.demand == Demand::kForcePersists && in.comes != HoldCause::kNone;
    cause_ = comes ? in.comes : Reason(rule.cause);
  }
  if (state_ == State::kEngaged && rule.to != State::kEngaged) {
    left_at_ = in.stalled_since.value_or(in.now);
    expired_ = false;
    if (rule.demand == Demand::kSilent) count_silence(in);
  }
  state_ = rule.to;
}

double SlaveSafety::news_age_s(Time now) const {
  return echo_sent_ ? to_seconds(now - *echo_sent_) : std::numeric_limits<double>::infinity();
}

}  // namespace longreach
