#include "master/safety/master_safety.hpp"

#include <algorithm>
#include <utility>

#include "common/safety/ended_request.hpp"

namespace longreach {

enum class MasterSafety::Demand : std::uint8_t {
  kDeviceFault,
  kHandleOutside,
  kHandleJumped,
  kStop,
  kEngage,
  kSlaveStopped,
  kSlaveFault,
  kTaken,
  kRestarted,
  kHold,
  kLetGo,
  kHandStale,
  kStalled,
  kSilent,
  kDelayRose,
  kOverrun,
  kSlaveHolds,
  kSlaveEngaged,
  kRefused,
  kUnanswered,
  kReceived
};

namespace {

using State = SafetyState;
using Cause = HoldCause;

// Times, in addition to the round trip, after which a request without a reply is given up or reported.
constexpr double kAnswer_s = 3.0;
constexpr double kOverdue_s = 1.0;
// Round-trip times assumed while it is unknown, for reporting and for giving up.
constexpr double kLongTrip_s = 10.0;
constexpr double kUnknownTrip_s = 60.0;
// Time for which engage_at_start repeats a request that is not granted.
constexpr double kRepeated_s = 30.0;
constexpr double kRoundTrips = 4.0;

constexpr unsigned in(State state) { return 1U << static_cast<unsigned>(state); }
constexpr unsigned kAny = ~0U;
constexpr unsigned kFollowed = in(State::kEngaged) | in(State::kHolding);
constexpr unsigned kFollowing = in(State::kObserving) | in(State::kEngaged) | in(State::kHolding);

}  // namespace

struct MasterSafety::Rule {
  unsigned from;
  bool active;  // the rule applies only while an engagement is requested
  Demand demand;
  State to;
  HoldCause cause;
  Request request;
};

const MasterSafety::Rule MasterSafety::kTable[] = {
    {kAny, false, Demand::kDeviceFault, State::kFault, Cause::kDeviceFault, Request::kHold},
    {kAny, false, Demand::kHandleOutside, State::kFault, Cause::kHandleOutside, Request::kHold},
    {kFollowing, true, Demand::kHandleJumped, State::kFault, Cause::kHandleJumped, Request::kHold},
    {kAny & ~in(State::kFault), false, Demand::kStop, State::kStopped, Cause::kOperator, Request::kStop},
    {kAny, false, Demand::kEngage, State::kObserving, Cause::kNone, Request::kEngage},
    {kFollowing, true, Demand::kSlaveStopped, State::kStopped, Cause::kPeerHolds, Request::kHold},
    {kFollowing, true, Demand::kSlaveFault, State::kHolding, Cause::kRobotFault, Request::kHold},
    {kFollowed, false, Demand::kTaken, State::kHolding, Cause::kPreempted, Request::kHold},
    {kFollowed, false, Demand::kRestarted, State::kHolding, Cause::kPeerRestarted, Request::kHold},
    {in(State::kObserving), true, Demand::kRestarted, State::kHolding, Cause::kPeerRestarted, Request::kHold},
    {kFollowing, true, Demand::kHold, State::kHolding, Cause::kOperator, Request::kHold},
    {kFollowing, true, Demand::kLetGo, State::kHolding, Cause::kHandleReleased, Request::kLetGo},
    {kFollowing, true, Demand::kHandStale, State::kHolding, Cause::kHandStale, Request::kHold},
    {kFollowing, true, Demand::kStalled, State::kHolding, Cause::kStalled, Request::kEngage},
    {kFollowing, true, Demand::kSilent, State::kHolding, Cause::kLinkSilent, Request::kEngage},
    {in(State::kEngaged), true, Demand::kDelayRose, State::kHolding, Cause::kDelayRose, Request::kHold},
    {in(State::kEngaged), true, Demand::kOverrun, State::kHolding, Cause::kOverrun, Request::kHold},
    {in(State::kEngaged), true, Demand::kSlaveHolds, State::kHolding, Cause::kPeerHolds, Request::kEngage},
    {kFollowing, true, Demand::kSlaveEngaged, State::kEngaged, Cause::kNone, Request::kEngage},
    {in(State::kObserving), true, Demand::kRefused, State::kObserving, Cause::kUnanswered, Request::kHold},
    {in(State::kObserving), true, Demand::kUnanswered, State::kObserving, Cause::kUnanswered, Request::kHold},
    {in(State::kIdle), false, Demand::kReceived, State::kObserving, Cause::kNone, Request::kHold}};

void MasterSafety::on_report(const StiffnessReport& report) {
  far_state_ = report.state;
  far_cause_ = report.cause;
  far_engagement_ = report.engagement;
  far_refused_ = report.refused;
  far_refusal_ = report.refusal;
}

bool MasterSafety::step(const MasterSafetyInput& input) {
  observe(input);
  const auto applies = [&](const Rule& rule) {
    return (rule.from & in(state_)) != 0 && (!rule.active || active()) && demanded(rule.demand, input);
  };
  const Rule* rule = std::ranges::find_if(kTable, applies);
  const bool wanted = wants(input);
  const bool begun = rule != std::end(kTable) && enter(*rule, input);
  // A request of engage_at_start waits for the first datagram.
  if (wanted && !pending() && (input.engage || input.last_heard))
    refusal_ = why_not(input), far_refuses_ = false;
  explain(input);
  // The slave may have held several times since its first report; the newest one says how often.
  if (state_ == State::kHolding && far_is_cause_ && says(State::kHolding) && far_cause_.cause == cause_.cause)
    cause_ = far_cause_;
  if (input.stop) request_ = Request::kStop;
  if (state_ == State::kHolding && active()) {
    const bool late = to_seconds(input.now - left_at_) > config_.resume_s;
    request_ = late ? Request::kHold : let_go_ ? Request::kLetGo : Request::kEngage;
  }
  return begun;
}

bool MasterSafety::active() const { return request_ == Request::kEngage || request_ == Request::kLetGo; }

void MasterSafety::observe(const MasterSafetyInput& in) {
  stale_ = in.last_heard && to_seconds(in.now - *in.last_heard) > config_.silence_s;
  restarted_ = in.peer_restarts != peer_restarts_;
  peer_restarts_ = in.peer_restarts;
  if (restarted_) far_state_ = State::kObserving;
  if (restarted_ || in.stalled_since) far_engagement_ = far_refused_ = 0;
  if (in.held) held_at_ = in.now;
  hand_missing_ = config_.presence == Presence::kHold && !in.held;
  let_go_ = hand_missing_ && to_seconds(in.now - held_at_) > config_.presence_s;
  if (!says(State::kHolding)) held_since_ = in.now;
  reported_ = reported_ || in.hold || in.stop;
}

bool MasterSafety::demanded(Demand demand, const MasterSafetyInput& in) const {
  switch (demand) {
    case Demand::kDeviceFault:
      return !in.device_ok;
    case Demand::kHandleOutside:
      return in.handle == Cause::kHandleOutside;
    case Demand::kHandleJumped:
      return in.handle == Cause::kHandleJumped;
    case Demand::kStop:
      return in.stop;
    case Demand::kEngage:
      return wants(in) && why_not(in) == Cause::kNone;
    case Demand::kSlaveStopped:
      return says(State::kStopped);
    case Demand::kSlaveFault:
      return says(State::kFault);
    case Demand::kTaken:
      return in.taken;
    case Demand::kRestarted:
      return restarted_;
    case Demand::kHold:
      return in.hold;
    case Demand::kLetGo:
      return let_go_;
    case Demand::kHandStale:
      return in.hand_stale;
    case Demand::kStalled:
      return in.stalled_since.has_value();
    case Demand::kSilent:
      return stale_;
    case Demand::kDelayRose:
      return in.delay_rose;
    case Demand::kOverrun:
      return in.overrun;
    case Demand::kSlaveHolds:
      return says(State::kHolding);
    case Demand::kSlaveEngaged:
      return says(State::kEngaged);
    case Demand::kRefused:
      return refused();
    case Demand::kUnanswered:
      return unanswered(in);
    case Demand::kReceived:
      return in.last_heard.has_value();
  }
  return true;
}

// Returns whether the operator or engage_at_start requests an engagement that is neither pending nor active.
bool MasterSafety::wants(const MasterSafetyInput& in) const {
  const bool rests = state_ == State::kIdle || state_ == State::kObserving;
  // On a slow link, the first answers take several round trips.
  const bool repeats = !first_asked_at_ || !in.rtt_s ||
                       to_seconds(in.now - *first_asked_at_) < kRepeated_s + kRoundTrips * *in.rtt_s;
  const bool by_itself = config_.engage_at_start && !reported_ && repeats && rests && !active();
  return (in.engage && !pending() && state_ != State::kEngaged) || by_itself;
}

// Returns why this side does not forward the request to the slave; kNone if it does.
Reason MasterSafety::why_not(const MasterSafetyInput& in) const {
  if (!in.device_ok) return Cause::kDeviceFault;
  if (in.handle != Cause::kNone) return in.handle;
  if (in.stop) return Cause::kOperator;
  if (in.taken) return Cause::kPreempted;
  if (!in.last_heard || stale_) return Cause::kLinkSilent;
  if (hand_missing_) return Cause::kHandleReleased;
  if (in.hand_stale) return Cause::kHandStale;
  return in.stalled_since ? Cause::kStalled : Cause::kNone;
}

void MasterSafety::explain(const MasterSafetyInput& in) {
  if (state_ == State::kEngaged || in.stop || in.hold) refusal_ = Reason{};
  if (!pending()) return;
  const bool overdue = to_seconds(in.now - asked_at_) > in.rtt_s.value_or(kLongTrip_s) + kOverdue_s;
  if (far_refused_ == engagement_ || says(State::kHolding)) {
    refusal_ = far_refused_ == engagement_ ? far_refusal_ : far_cause_;
    far_refuses_ = true;
  } else if (overdue) {
    refusal_ = Cause::kUnanswered;
    far_refuses_ = false;
  }
}

std::optional<double> MasterSafety::answer_in_s(const MasterSafetyInput& in) const {
  if (!pending() || !in.rtt_s) return std::nullopt;
  return std::max(0.0, *in.rtt_s - to_seconds(in.now - asked_at_));
}

// Returns whether the slave reports `state` for the current engagement.
bool MasterSafety::says(SafetyState state) const {
  return far_engagement_ == engagement_ && far_state_ == state;
}

// Returns whether the slave has refused the current engagement for good.
bool MasterSafety::refused() const { return far_refused_ == engagement_ && ends_request(far_refusal_); }

// If the slave engaged but already holds when its first report arrives, it resumes automatically within
// resume_s or not at all.
bool MasterSafety::unanswered(const MasterSafetyInput& in) const {
  if (to_seconds(in.now - held_since_) > config_.resume_s) return true;
  return to_seconds(in.now - asked_at_) > in.rtt_s.value_or(kUnknownTrip_s) + kAnswer_s;
}

bool MasterSafety::enter(const Rule& rule, const MasterSafetyInput& in) {
  const bool was_holding = state_ == State::kHolding;
  const bool false_hold = was_holding && cause_ != HoldCause::kHandleReleased;
  const bool explains = rule.demand == Demand::kTaken || rule.demand == Demand::kRestarted;
  if (rule.to == State::kFault || rule.demand == Demand::kStop) {
    if (state_ != rule.to) take_cause(rule, in);
  } else if (rule.demand == Demand::kEngage || rule.to == State::kEngaged) {
    cause_ = HoldCause::kNone;
  } else if (cause_ == HoldCause::kNone || (explains && cause_ == HoldCause::kLinkSilent)) {
    take_cause(rule, in);
  }
  if (rule.demand == Demand::kRefused) {
    refusal_ = far_refusal_;
    far_refuses_ = reported_ = true;
  }
  if (rule.to == State::kHolding && !was_holding) left_at_ = in.stalled_since.value_or(in.now);
  state_ = rule.to;
  if (request_ != Request::kStop || rule.demand == Demand::kEngage) request_ = rule.request;
  if (rule.demand == Demand::kEngage) begin(in);
  if (state_ != State::kEngaged) return false;
  if (false_hold && confirmed_) ++false_holds_;
  reported_ = true;
  return !std::exchange(confirmed_, true);
}

// The cause that the slave reports takes precedence over the cause of the rule.
void MasterSafety::take_cause(const Rule& rule, const MasterSafetyInput& in) {
  const bool its_own = rule.demand == Demand::kSlaveStopped || rule.demand == Demand::kSlaveFault ||
                       rule.demand == Demand::kSlaveHolds ||
                       (rule.demand == Demand::kUnanswered && says(State::kHolding));
  const bool of_the_handle = rule.demand == Demand::kHandleOutside || rule.demand == Demand::kHandleJumped;
  far_is_cause_ = its_own && far_cause_ != HoldCause::kNone;
  cause_ = far_is_cause_ ? far_cause_ : of_the_handle ? in.handle : Reason(rule.cause);
  const bool ends = rule.demand == Demand::kRefused || rule.demand == Demand::kUnanswered;
  if (!ends || far_refused_ != engagement_) return;
  far_is_cause_ = true;
  cause_ = far_refusal_;
}

// Starts an engagement. Its number is greater than any that the slave may have from another master.
void MasterSafety::begin(const MasterSafetyInput& in) {
  engagement_ = std::max(engagement_, far_engagement_) + 1;
  asked_at_ = in.now;
  confirmed_ = false;
  reported_ = reported_ || in.engage;
  if (!reported_ && !first_asked_at_) first_asked_at_ = in.now;
  // What a repeated request was refused for stays visible, unless this side has forwarded the request since.
  const bool overcome = !far_refuses_ && refusal_ != HoldCause::kUnanswered;
  if (in.engage || overcome) refusal_ = Reason{};
}

}  // namespace longreach
