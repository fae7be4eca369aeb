// I11, I29, I30: what the slave claims of its state is true of what it was given.

#include <algorithm>

#include "tests/experiments/faults/invariant.hpp"

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
    that(m, m.engagement > m.ghost->ended(),
         "engaged in an engagement that a hold, a stop or a long silence has ended");
    that(m, m.engagement <= m.ghost->asks(), "engaged more often than anybody asked");
    at_most(m, m.slave_gap_s, resume_s_, "s that the slave did not run, and engaged in the tick after");
  }

 private:
  /// A master that was engaged and did not run for so long asks for that engagement no more.
  void see_master(const Moment& m) {
    if (!m.master_ran) return;
    if (m.master_gap_s > resume_s_ && shown_ == SafetyState::kEngaged) slept_ = m.ghost->numbers();
    shown_ = m.shown;
    const auto& sent = m.ghost->sent();
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
    const Right& right = m.ghost->right();
    const bool stop = m.stop_at_slave || (right.request == Request::kStop && right.heard_s == m.t_s);
    if (stop) {
      stopped_ = true;
      number_ = std::max(right.engagement, m.ghost->ended());
    }
    if (right.engaged && right.engagement > number_) stopped_ = false;
    if (stopped_ && m.report)
      that(m, m.claimed == SafetyState::kStopped || m.claimed == SafetyState::kFault,
           "a stop was given, and none is claimed");
  }

 private:
  bool stopped_ = false;
  std::uint32_t number_ = 0;
};

/// Every hold, stop and fault has a cause that was there.
class TrueCause : public Invariant {
 public:
  explicit TrueCause(const Scenario& s)
      : Invariant("I30", "what has stopped the robot is named, and was there"),
        gap_s_(gap_s(s.slave.safety, sent_hz(s.master.link))),
        recent_s_(kRecent_s + 2.0 * s.round_trip_s) {}
  void see(const Moment& m) override {
    remember(m);
    if (!m.report || (m.cause == cause_ && m.claimed == state_)) return;
    const bool began = m.cause != cause_ || state_ == SafetyState::kEngaged;
    cause_ = m.cause;
    state_ = m.claimed;
    const bool stands =
        state_ == SafetyState::kHolding || state_ == SafetyState::kStopped || state_ == SafetyState::kFault;
    if (stands && began) that(m, was_there(m), words());
  }

 private:
  void remember(const Moment& m) {
    const Right& right = m.ghost->right();
    if (right.heard_s < m.t_s - 0.75 * gap_s_) silent_s_ = m.t_s;
    if (m.stop_at_slave || right.request == Request::kStop || right.request == Request::kHold)
      asked_s_ = m.t_s;
    if (right.request == Request::kLetGo) let_go_s_ = m.t_s;
    if (m.slave_ran && m.slave_gap_s > 1.5 * m.period_s) slept_s_ = m.t_s;
    if (!m.F_E_W.force.isZero()) pressed_s_ = m.t_s;
    remember_delay(m);
  }
  /// Who repeats datagrams fills a narrow link with them.
  void remember_delay(const Moment& m) {
    const Right& right = m.ghost->right();
    if (right.heard_s == m.t_s) up_s_ = m.t_s - right.sent_s;
    if (m.report_came) down_s_ = m.report_age_s;
    least_up_s_ = std::min(least_up_s_, up_s_);
    least_down_s_ = std::min(least_down_s_, down_s_);
    if (up_s_ - least_up_s_ + down_s_ - least_down_s_ > kRise_s) rose_s_ = m.t_s;
  }
  [[nodiscard]] bool was_there(const Moment& m) const {
    const double recent_s = recent_s_ + m.slave_gap_s;  // it may have slept through it
    const auto lately = [&](double s) { return m.t_s - s < recent_s; };
    const auto spoilt = [&](Spoils what) { return m.since(what) < recent_s; };
    const bool robot = spoilt(Spoils::kRobot) || spoilt(Spoils::kJoints);
    switch (m.cause) {
      case HoldCause::kOperator:
        return lately(asked_s_);
      case HoldCause::kLinkSilent:
        return lately(silent_s_);
      case HoldCause::kLinkStale:
      case HoldCause::kDelayRose:
        return lately(rose_s_) || spoilt(Spoils::kLink) || lately(slept_s_) || spoilt(Spoils::kMasterTime);
      case HoldCause::kPeerRestarted:
      case HoldCause::kTaken:
        return spoilt(Spoils::kLease);
      case HoldCause::kRobotFault:
        return robot || spoilt(Spoils::kSensor);
      case HoldCause::kRobotRestless:
      case HoldCause::kRobotAstray:
        return robot || spoilt(Spoils::kSlaveTime) || lately(pressed_s_);
      case HoldCause::kHandleLetGo:
        return lately(let_go_s_);
      case HoldCause::kStalled:
      case HoldCause::kOverrun:
        return lately(slept_s_);
      case HoldCause::kSensorFault:
      case HoldCause::kSensorSign:
        return spoilt(Spoils::kSensor) || spoilt(Spoils::kScene) || robot;
      case HoldCause::kNoRelief:
        return spoilt(Spoils::kSensor) || spoilt(Spoils::kScene) || robot || lately(pressed_s_);
      default:
        return false;
    }
  }
  [[nodiscard]] const char* words() const {
    return cause_ == HoldCause::kNone ? "it stands, and no cause is named"
                                      : "the cause that is named was not there";
  }

  double gap_s_, recent_s_;
  HoldCause cause_ = HoldCause::kNone;
  SafetyState state_ = SafetyState::kIdle;
  static constexpr double kRise_s = 0.5;
  double up_s_ = 1e9, down_s_ = 1e9, least_up_s_ = 1e9, least_down_s_ = 1e9;
  double rose_s_ = -1e9, silent_s_ = -1e9, asked_s_ = -1e9, let_go_s_ = -1e9, slept_s_ = -1e9,
         pressed_s_ = -1e9;
};

}  // namespace

void add_state_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<NoSelfResume>(s));
  all.push_back(std::make_unique<MostSevereWins>(s));
  all.push_back(std::make_unique<TrueCause>(s));
}

}  // namespace longreach
