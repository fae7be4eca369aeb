#pragma once
// The master's safety machine: which state it is in, why, and which level it requests from the slave. One
// table; the first row that applies is taken, so the most severe demand wins:
//
//   state             condition                                     next       cause                 request
//   any               the device has failed                         Fault      device fault          hold
//   any but Fault     the operator asks for a stop                  Stopped    operator              stop
//   any               the operator asks to engage, and may          Observing  -                     engage
//   active            the slave says that it has stopped            Stopped    as the slave says     hold
//   active            the slave says that it has a fault            Holding    as the slave says     hold
//   Engaged, Holding  another master has taken control of the robot            Holding    taken                 hold
//   active            the slave began a new session                 Holding    other side restarted  hold
//   active            the operator asks for a hold                  Holding    operator              hold
//   active            no hand for presence_s (presence = HOLD)      Holding    handle let go         let go
//   active            what is known of the hand is too old          Holding    hand stale            hold
//   active            this tick came later than gap_s               Holding    stalled               engage
//   active            silence > silence_s                           Holding    link silent           engage
//   Engaged           the round trip rose > delay_rise_max_s        Holding    delay rose            hold
//   Engaged           half of a second's ticks came late            Holding    overrun               hold
//   Engaged           the slave says that it holds                  Holding    as the slave says     engage
//   active            the slave says that it is engaged             Engaged    -                     engage
//   active Observing  not granted for a round trip and 3 s          Observing  as refused, unanswered  hold
//   Idle              the slave is heard                            Observing  -                     hold
//
// Active: in Observing, Engaged or Holding, while an engagement is requested. A hold for longer than resume_s
// requests hold and so is active no more: only a new engagement goes on. The operator may engage when the
// slave is heard, the hand is known and, with presence = HOLD, on the handle; whatever state it was, this is
// the only way out of Stopped and Fault. While an engagement waits for its answer, or is followed, asking for
// one changes nothing. A tick that comes later than gap_s after the one before is a hold from then on,
// forgets what the slave had said and takes no engagement. Round trip and late ticks: as
// slave/safety/slave_safety.hpp. What the slave says counts if it says it of this engagement's number. A stop is
// requested in Fault, too, and until the next engagement. The cause is the first since Engaged, but that a
// robot was taken explains a silence; a fault has its own. An engagement that is asked for and not granted
// has a reason: at once where this side does not ask the slave; else the slave's when it has come, and
// without any `unanswered` 1 s after the round trip. It stays until another is asked for, or is granted.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "master/config/master_config.hpp"

namespace longreach {

struct MasterSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};  // any valid datagram of the slave
  std::uint32_t peer_restarts = 0;   // sessions of the slave after its first
  bool taken = false;                // another master has control of the robot: a level
  bool device_ok = true;
  bool held = true;         // a hand is on the handle
  bool hand_stale = false;  // what is known of it is too old: a level
  bool engage = false;      // asked for in this tick
  bool hold = false;
  bool stop = false;
  std::optional<double> rtt_s{};        // of the link, once known
  std::optional<Time> stalled_since{};  // the tick before, where it is longer ago than gap_s
  bool delay_rose = false;              // the round trip, by more than delay_rise_max_s
  bool overrun = false;                 // this side does not keep its rate
};

class MasterSafety {
 public:
  explicit MasterSafety(const MasterSafetyConfig& config) : config_(config) {}
  void configure(const MasterSafetyConfig& config) { config_ = config; }
  [[nodiscard]] const MasterSafetyConfig& config() const { return config_; }

  /// What the slave says of itself, in the order of arrival.
  void on_report(const StiffnessReport& report);

  /// One tick. True if an engagement has just been confirmed: everything begins at rest.
  bool step(const MasterSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  [[nodiscard]] bool cause_is_far() const { return far_is_cause_; }  // it is the slave's
  /// Why the engagement that was asked for last is not granted; kNone: it is, or it is too early to say.
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  [[nodiscard]] bool refusal_is_far() const { return far_refuses_; }
  [[nodiscard]] SafetyState far_state() const { return far_state_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }
  [[nodiscard]] Request request() const { return request_; }
  /// An engagement waits for its answer.
  [[nodiscard]] bool pending() const { return state_ == SafetyState::kObserving && active(); }
  /// Then: the seconds until that can be here. None: not, or not known.
  [[nodiscard]] std::optional<double> answer_in_s(const MasterSafetyInput& in) const;
  [[nodiscard]] bool stale() const { return stale_; }                // nothing heard for silence_s
  [[nodiscard]] bool hand_missing() const { return hand_missing_; }  // no engagement without it
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

 private:
  enum class Demand : std::uint8_t;
  struct Rule;
  static const Rule kTable[];

  void observe(const MasterSafetyInput& in);
  [[nodiscard]] bool active() const;
  [[nodiscard]] bool demanded(Demand demand, const MasterSafetyInput& in) const;
  [[nodiscard]] bool wants(const MasterSafetyInput& in) const;
  [[nodiscard]] Reason why_not(const MasterSafetyInput& in) const;
  void explain(const MasterSafetyInput& in);
  void take_cause(const Rule& rule);
  [[nodiscard]] bool says(SafetyState state) const;
  [[nodiscard]] bool unanswered(const MasterSafetyInput& in) const;
  void begin(const MasterSafetyInput& in);
  bool enter(const Rule& rule, const MasterSafetyInput& in);

  MasterSafetyConfig config_;
  SafetyState state_ = SafetyState::kIdle;
  Reason cause_{};
  bool far_is_cause_ = false;
  Reason refusal_{};
  bool far_refuses_ = false;
  Request request_ = Request::kHold;
  std::uint32_t engagement_ = 0;
  SafetyState far_state_ = SafetyState::kIdle;
  Reason far_cause_{};
  std::uint32_t far_engagement_ = 0;
  std::uint32_t far_refused_ = 0;
  Reason far_refusal_{};
  std::uint32_t peer_restarts_ = 0;
  bool restarted_ = false;  // in this tick
  bool stale_ = false;
  bool hand_missing_ = false;
  bool let_go_ = false;     // for longer than presence_s
  Time held_at_{};          // last
  bool reported_ = false;   // the operator has engaged, held or stopped, or engage_at_start was answered
  bool confirmed_ = false;  // the present engagement was confirmed
  Time asked_at_{};         // for the present engagement
  Time held_since_{};       // the slave says that it holds in it
  Time left_at_{};          // when Engaged, or asking for it, was left: of a stall, when it began
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
