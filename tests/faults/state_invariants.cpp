// I11, I29, I30, I33: what is claimed of a state, and of why it is one, is true.

#include <algorithm>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kRecent_s = 3.0;  // and as long as a link needs to show it

class NoSelfResume : public Invariant {
 public:
  explicit NoSelfResume(const Scenario& s)
      : Invariant("I11", "engaged by an explicit request alone, made after the last stop"),
        resume_s_(s.slave.safety.resume_s) {}
  void see(const Moment& m) override {
    see_master(m);
    if (!m.report || m.claimed != SafetyState::kEngaged) return;
    that(m, m.engagement > m.sent_log->ended(),
         "engaged in an engagement that a hold, a stop or a long silence has ended");
    that(m, m.engagement <= m.sent_log->asks(), "engaged more often than anybody asked");
    at_most(m, m.slave_gap_s, resume_s_, "s that the slave did not run, and engaged in the tick after");
  }

 private:
  /// A master that was engaged and did not run for so long asks for that engagement no more.
  void see_master(const Moment& m) {
    if (!m.master_ran) return;
    if (m.master_gap_s > resume_s_ && shown_ == SafetyState::kEngaged) slept_ = m.sent_log->numbers();
    shown_ = m.shown;
    const auto& sent = m.sent_log->sent();
    if (slept_ == 0 || sent.empty() || sent.back().t_s != m.t_s) return;
    that(m, sent.back().command.request != Request::kEngage || sent.back().command.engagement > slept_,
         "the master did not run for long, and goes on by itself");
  }

  double resume_s_;
  SafetyState shown_ = SafetyState::kIdle;
  std::uint32_t slept_ = 0;  // engagements up to this one it has slept through
};

class MostSevereWins : public Invariant {
 public:
  explicit MostSevereWins(const Scenario&)
      : Invariant("I29", "a stop is a stop, whatever else is asked for") {}
  void see(const Moment& m) override {
    if (!m.slave_ran) return;
    const MotionAuthority& authority = m.sent_log->authority();
    const bool stop =
        m.stop_at_slave || (authority.request == Request::kStop && authority.received_s == m.t_s);
    if (stop) {
      stopped_ = true;
      number_ = std::max(authority.engagement, m.sent_log->ended());
    }
    if (authority.engaged && authority.engagement > number_) stopped_ = false;
    if (stopped_ && m.report)
      that(m, m.claimed == SafetyState::kStopped || m.claimed == SafetyState::kFault,
           "a stop was given, and none is claimed");
  }

 private:
  bool stopped_ = false;
  std::uint32_t number_ = 0;
};

/// What was there lately of what a cause may name: plant, wire and schedule.
class Circumstances {
 public:
  explicit Circumstances(const Scenario& s)
      : gap_s_(gap_s(s.slave.safety, sent_hz(s.master.link))),
        recent_s_(kRecent_s + 2.0 * s.round_trip_s),
        robot_(s.slave.robot),
        centre_m_(start_pose(s).p),
        workspace_m_(s.slave.command.workspace_m),
        zero_s_(s.slave.sensing.zero_s) {}

  void remember(const Moment& m) {
    const MotionAuthority& authority = m.sent_log->authority();
    if (authority.received_s < m.t_s - 0.75 * gap_s_) silent_s_ = m.t_s;
    if (m.stop_at_slave || authority.request == Request::kStop) asked_s_ = m.t_s;
    if (authority.request == Request::kHold || authority.request == Request::kStop) held_s_ = m.t_s;
    if (authority.request == Request::kLetGo) let_go_s_ = m.t_s;
    if (m.taken) taken_s_ = m.t_s;
    if (m.renewed) renewed_s_ = m.t_s;
    if (m.slave_ran && m.slave_gap_s > 1.5 * m.period_s) slept_s_ = m.t_s;
    if (m.master_ran && m.master_gap_s > 1.5 * m.period_s) master_slept_s_ = m.t_s;
    if (!m.F_E_W.force.isZero()) pressed_s_ = m.t_s;
    if (beyond(m)) beyond_s_ = m.t_s;
    if ((m.X_WE.p - centre_m_).norm() > workspace_m_) outside_s_ = m.t_s;
    if (m.report_came || m.seen) news_s_ = m.t_s;
    if (m.t_s - news_s_ > kQuiet_s) unreceived_s_ = m.t_s;
    if (!m.handle.ok) handle_s_ = m.t_s;
    remember_delay(m);
  }

  enum class At : std::uint8_t { kSlave, kMaster };
  /// Whether what `cause` says of a side was there lately.
  [[nodiscard]] bool had(const Moment& m, HoldCause cause, At at) const {
    const double recent_s = recent_s_ + m.slave_gap_s;  // it may have slept through it
    const auto lately = [&](double s) { return m.t_s - s < recent_s; };
    const auto affected = [&](AffectedSignal what) { return m.since(what) < recent_s; };
    const bool robot = affected(AffectedSignal::kRobot) || affected(AffectedSignal::kJoints);
    switch (cause) {
      case HoldCause::kOperator:
        return lately(asked_s_);
      case HoldCause::kPeerHolds:
        return lately(held_s_);
      case HoldCause::kLinkSilent:
        return lately(silent_s_) || (at == At::kMaster && lately(unreceived_s_));
      case HoldCause::kLinkStale:
      case HoldCause::kDelayRose:
        return lately(rose_s_) || affected(AffectedSignal::kLink) || lately(slept_s_) ||
               affected(AffectedSignal::kMasterTime);
      case HoldCause::kPeerRestarted:
      case HoldCause::kPreempted:
        return leased(m, cause, at, recent_s);
      case HoldCause::kRobotFault:
      case HoldCause::kJointJumped:
      case HoldCause::kJointOutside:
      case HoldCause::kJointTooFast:
        return robot || affected(AffectedSignal::kSensor);
      case HoldCause::kUncommandedMotion:
      case HoldCause::kTrackingLost:
      case HoldCause::kRobotMoves:
        return robot || affected(AffectedSignal::kSlaveTime) || lately(pressed_s_);
      case HoldCause::kJointLimit:
        return robot || lately(beyond_s_);
      case HoldCause::kToolOutside:
        return robot || lately(outside_s_);
      case HoldCause::kSensorZeroing:
        return m.t_s < zero_s_ + recent_s || robot || affected(AffectedSignal::kSensor) || lately(pressed_s_);
      case HoldCause::kDeviceFault:
      case HoldCause::kHandleJumped:
      case HoldCause::kHandleOutside:
      case HoldCause::kHandStale:
        return lately(handle_s_) || affected(AffectedSignal::kHandle);
      case HoldCause::kHandleReleased:
        return lately(let_go_s_) || affected(AffectedSignal::kOperator) || affected(AffectedSignal::kHandle);
      case HoldCause::kStalled:
      case HoldCause::kOverrun:
        return lately(slept_s_) || lately(master_slept_s_);
      case HoldCause::kUnanswered:
        return lately(unreceived_s_) || lately(silent_s_) || wire(m) < recent_s;
      case HoldCause::kSensorFault:
      case HoldCause::kSensorConstant:
        return affected(AffectedSignal::kSensor) || affected(AffectedSignal::kScene) || robot;
      // Nothing that surroundings do is taken for a sensor with a wrong sign.
      case HoldCause::kSensorSign:
        return affected(AffectedSignal::kSensor) || robot;
      case HoldCause::kForcePersists:
      case HoldCause::kSurfaceApproaching:
        return affected(AffectedSignal::kSensor) || affected(AffectedSignal::kScene) || robot ||
               lately(pressed_s_);
      default:
        return false;
    }
  }

 private:
  static constexpr double kRise_s = 0.5, kQuiet_s = 0.4;
  /// Seconds since what the two sides say to each other was last disturbed.
  static double wire(const Moment& m) {
    double least_s = 1e9;
    for (const AffectedSignal what :
         {AffectedSignal::kLink, AffectedSignal::kLease, AffectedSignal::kSlaveTime,
          AffectedSignal::kMasterTime, AffectedSignal::kMaster, AffectedSignal::kSlave})
      least_s = std::min(least_s, m.since(what));
    return least_s;
  }
  /// Who repeats datagrams fills a narrow link with them.
  void remember_delay(const Moment& m) {
    const MotionAuthority& authority = m.sent_log->authority();
    if (authority.received_s == m.t_s) up_s_ = m.t_s - authority.sent_s;
    if (m.report_came) down_s_ = m.report_age_s;
    least_up_s_ = std::min(least_up_s_, up_s_);
    least_down_s_ = std::min(least_down_s_, down_s_);
    if (up_s_ - least_up_s_ + down_s_ - least_down_s_ > kRise_s) rose_s_ = m.t_s;
  }
  [[nodiscard]] bool leased(const Moment& m, HoldCause cause, At at, double recent_s) const {
    const double leased_s = cause == HoldCause::kPreempted ? taken_s_ : renewed_s_;
    return m.since(AffectedSignal::kLease) < recent_s && (at == At::kMaster || m.t_s - leased_s < recent_s);
  }
  [[nodiscard]] bool beyond(const Moment& m) const {
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
      const double q = m.truth.joint_rad[i];
      if (j.kind != JointKind::kFixed && (q < j.min_rad || q > j.max_rad)) return true;
    }
    return false;
  }

  double gap_s_, recent_s_;
  RobotConfig robot_;
  Vector3 centre_m_;
  double workspace_m_, zero_s_;
  double up_s_ = 1e9, down_s_ = 1e9, least_up_s_ = 1e9, least_down_s_ = 1e9;
  double rose_s_ = -1e9, silent_s_ = -1e9, asked_s_ = -1e9, held_s_ = -1e9, let_go_s_ = -1e9, slept_s_ = -1e9,
         master_slept_s_ = -1e9, pressed_s_ = -1e9, beyond_s_ = -1e9, outside_s_ = -1e9, news_s_ = -1e9,
         unreceived_s_ = -1e9, handle_s_ = -1e9, taken_s_ = -1e9, renewed_s_ = -1e9;
};

/// Every hold, stop and fault has a cause that was there.
class TrueCause : public Invariant {
 public:
  explicit TrueCause(const Scenario& s)
      : Invariant("I30", "what has stopped the robot is named, and was there"), there_(s) {}
  void see(const Moment& m) override {
    there_.remember(m);
    if (!m.report || (m.cause == cause_ && m.claimed == state_)) return;
    const bool began = m.cause != cause_ || state_ == SafetyState::kEngaged;
    cause_ = m.cause;
    state_ = m.claimed;
    const bool stands =
        state_ == SafetyState::kHolding || state_ == SafetyState::kStopped || state_ == SafetyState::kFault;
    if (stands && began) that(m, there_.had(m, cause_, Circumstances::At::kSlave), words());
  }

 private:
  [[nodiscard]] const char* words() {
    if (cause_ == HoldCause::kNone) return "it stands, and no cause is named";
    words_ = "the cause that is named was not there: " + std::string(text_of(cause_).name);
    return words_.c_str();
  }

  Circumstances there_;
  HoldCause cause_ = HoldCause::kNone;
  SafetyState state_ = SafetyState::kIdle;
  std::string words_;
};

/// Whoever asks for an engagement that is not granted within a round trip and a second is shown why, and that
/// is so.
class ReportedCause : public Invariant {
 public:
  explicit ReportedCause(const Scenario& s)
      : Invariant("I33", "an engagement that is not granted has a reason that is shown, and true"),
        there_(s),
        round_trip_s_(s.round_trip_s) {}
  void see(const Moment& m) override {
    there_.remember(m);
    if (!m.master_ran) return;
    const std::uint32_t number = m.sent_log->numbers();
    if (m.shown == SafetyState::kEngaged || m.stop_asked || m.hold_asked) asks_ = false;
    if (m.engage_asked) last_ask_s_ = m.t_s;
    const bool asked = m.engage_asked && m.shown != SafetyState::kEngaged;
    if ((asked && !asks_) || number != number_) asked_s_ = m.t_s;
    asks_ = asks_ || asked;
    number_ = number;
    // What is asked for comes later, or is not heard of, where the way is disturbed.
    const double way_s = kRecent_s + 2.0 * round_trip_s_;
    // A narrow link on which a stranger sends as well is late by what queues there.
    const MotionAuthority& authority = m.sent_log->authority();
    const double late_s = round_trip_s_ + kLate_s;
    if (authority.received_s - authority.sent_s > late_s || (m.report_came && m.report_age_s > late_s))
      late_s_ = m.t_s;
    const bool disturbed = m.t_s - late_s_ < way_s || m.since(AffectedSignal::kLink) < way_s ||
                           m.since(AffectedSignal::kMasterTime) < way_s ||
                           m.since(AffectedSignal::kSlaveTime) < way_s ||
                           m.since(AffectedSignal::kLease) < way_s;
    if (disturbed) asked_s_ = std::max(asked_s_, m.t_s);
    // Asking again may begin anew, which the next command shows.
    const bool anew = m.t_s - last_ask_s_ < kSent_s;
    if (!asks_ || anew || m.t_s - asked_s_ < round_trip_s_ + kReason_s) return;
    that(m, m.reason != HoldCause::kNone,
         "an engagement was asked for, and nothing says why it is not there");
    if (m.reason == HoldCause::kNone || m.reason == shown_) return;
    shown_ = m.reason;
    words_ = "the reason that is shown was not there: " + std::string(text_of(m.reason).name);
    // A fault that still stands may be old: I30 has judged its cause as it began.
    const bool stands = m.reason_is_far && m.claimed == SafetyState::kFault && m.cause == m.reason;
    using At = Circumstances::At;
    that(m, stands || there_.had(m, m.reason, m.reason_is_far ? At::kSlave : At::kMaster), words_.c_str());
  }

 private:
  static constexpr double kReason_s = 1.1, kSent_s = 0.05, kLate_s = 0.1;
  Circumstances there_;
  double round_trip_s_;
  bool asks_ = false;
  std::uint32_t number_ = 0;
  double asked_s_ = 0.0, last_ask_s_ = -1e9, late_s_ = -1e9;
  HoldCause shown_ = HoldCause::kNone;
  std::string words_;
};

}  // namespace

void add_state_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<NoSelfResume>(s));
  all.push_back(std::make_unique<MostSevereWins>(s));
  all.push_back(std::make_unique<TrueCause>(s));
  all.push_back(std::make_unique<ReportedCause>(s));
}

}  // namespace longreach
