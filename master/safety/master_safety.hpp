#pragma once
// The safety state machine of the master: its state, the cause, and the state that it requests from the
// slave. One table; the first matching row applies, so the most severe demand takes precedence:
//
//   state             condition                                 next       cause                   request
//   any               the device has failed                     Fault      device fault            hold
//   any but Fault     the operator requests a stop              Stopped    operator                stop
//   any               the operator requests an engagement       Observing  -                       engage
//   active            the slave reports Stopped                 Stopped    that of the slave       hold
//   active            the slave reports Fault                   Holding    that of the slave       hold
//   Engaged, Holding  another master has taken control          Holding    preempted               hold
//   active            the slave started a new session           Holding    peer restarted          hold
//   active            the operator requests a hold              Holding    operator                hold
//   active            no hand for presence_s (presence = HOLD)  Holding    handle released         let go
//   active            the data of the hand is too old           Holding    hand stale              hold
//   active            this tick is later than gap_s             Holding    stalled                 engage
//   active            silence > silence_s                       Holding    link silent             engage
//   Engaged           the round trip rose > delay_rise_max_s    Holding    delay rose              hold
//   Engaged           half of the ticks of a second were late   Holding    overrun                 hold
//   Engaged           the slave reports Holding                 Holding    that of the slave       engage
//   active            the slave reports Engaged                 Engaged    -                       engage
//   active Observing  not granted for a round trip and 3 s      Observing  as refused, unanswered  hold
//   Idle              a datagram of the slave arrives           Observing  -                       hold
//
// Active: in Observing, Engaged or Holding, while an engagement is requested. A hold longer than resume_s
// requests hold and is then no longer active: only a new engagement resumes. The operator may engage when
// datagrams of the slave arrive, the state of the hand is known and, with presence = HOLD, a hand is on the
// handle; in any state, this is the only way out of Stopped and Fault. While an engagement is pending or
// active, another request has no effect. A tick later than gap_s after the previous one causes a hold,
// discards the last state of the slave and accepts no engagement. Round trip and late ticks are treated as in
// slave/safety/slave_safety.hpp. The state of the slave counts only for the number of this engagement. A stop
// is requested in Fault as well, until the next engagement. The cause is the first one since Engaged, except
// that preemption of the robot explains a silence; a fault has its own cause. A requested engagement that is
// not granted has a reason: immediately, if this side does not ask the slave; otherwise that of the slave on
// arrival, and without one `unanswered` 1 s after the round trip. It stays until another engagement is
// requested or granted.

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
  bool taken = false;                // another master has control of the robot: a state
  bool device_ok = true;
  bool held = true;         // a hand is on the handle
  bool hand_stale = false;  // the data of the hand is too old: a state
  bool engage = false;      // requested in this tick
  bool hold = false;
  bool stop = false;
  std::optional<double> rtt_s{};        // of the link, once known
  std::optional<Time> stalled_since{};  // time of the previous tick, if it is longer ago than gap_s
  bool delay_rose = false;              // the round trip has increased by more than delay_rise_max_s
  bool overrun = false;                 // this side does not keep its rate
};

class MasterSafety {
 public:
  explicit MasterSafety(const MasterSafetyConfig& config) : config_(config) {}
  void configure(const MasterSafetyConfig& config) { config_ = config; }
  [[nodiscard]] const MasterSafetyConfig& config() const { return config_; }

  /// Processes the reported states of the slave, in order of arrival.
  void on_report(const StiffnessReport& report);

  /// One tick. Returns true if an engagement has just been confirmed: everything starts at rest.
  bool step(const MasterSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  [[nodiscard]] bool cause_is_far() const { return far_is_cause_; }  // it is that of the slave
  /// Why the last requested engagement is not granted; kNone: it is granted, or the answer is pending.
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  [[nodiscard]] bool refusal_is_far() const { return far_refuses_; }
  [[nodiscard]] SafetyState far_state() const { return far_state_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }
  [[nodiscard]] Request request() const { return request_; }
  /// An engagement waits for its answer.
  [[nodiscard]] bool pending() const { return state_ == SafetyState::kObserving && active(); }
  /// Seconds until the answer can arrive. None: no engagement is pending, or unknown.
  [[nodiscard]] std::optional<double> answer_in_s(const MasterSafetyInput& in) const;
  [[nodiscard]] bool stale() const { return stale_; }                // no datagram for silence_s
  [[nodiscard]] bool hand_missing() const { return hand_missing_; }  // engagement is impossible without it
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
  Time held_at_{};          // last time
  bool reported_ = false;   // the operator has engaged, held or stopped, or engage_at_start was processed
  bool confirmed_ = false;  // the present engagement was confirmed
  Time asked_at_{};         // for the present engagement
  Time held_since_{};       // the slave reports that it holds
  Time left_at_{};          // when Engaged, or the request for it, ended: for a stall, its start
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
