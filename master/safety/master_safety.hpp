#pragma once
// The safety state machine of the master. It determines the state, its cause, and the state that the master
// requests from the slave. There is one table; the first matching rule applies, so that the most severe
// condition takes precedence:
//
//   state             condition                                 next       cause                   request
//   any               the device has failed                     Fault      device fault            hold
//   any               the handle is outside its workspace       Fault      handle outside          hold
//   active            the position of the handle jumped         Fault      handle jumped           hold
//   any but Fault     the operator requests a stop              Stopped    operator                stop
//   any               the operator requests an engagement       Observing  -                       engage
//   active            the slave reports Stopped                 Stopped    that of the slave       hold
//   active            the slave reports Fault                   Holding    that of the slave       hold
//   Engaged, Holding  another master has taken control          Holding    preempted               hold
//   Engaged, Holding  the slave started a new session           Holding    peer restarted          hold
//   active Observing  the slave started a new session           Holding    peer restarted          hold
//   active            the operator requests a hold              Holding    operator                hold
//   active            no hand for presence_s (presence = HOLD)  Holding    handle released         let go
//   active            the input from the hand is too old        Holding    hand stale              hold
//   active            this tick is later than gap_s             Holding    stalled                 engage
//   active            no datagram for silence_s                 Holding    link silent             engage
//   Engaged           the round trip rose > delay_rise_max_s    Holding    delay rose              hold
//   Engaged           half of the ticks of a second were late   Holding    overrun                 hold
//   Engaged           the slave reports Holding                 Holding    that of the slave       engage
//   active            the slave reports Engaged                 Engaged    -                       engage
//   active Observing  refused because of a fault                Observing  as refused              hold
//   active Observing  not granted for a round trip and 3 s      Observing  as refused, unanswered  hold
//   Idle              a datagram of the slave arrives           Observing  -                       hold
//
// Active means: in Observing, Engaged or Holding, while an engagement is requested. After a hold longer than
// resume_s the master requests a hold and is no longer active: only a new engagement resumes motion.
//
// A refusal because of a fault ends the request (common/safety/ended_request.hpp), so that the robot does not
// start when the fault ends; a new request is needed. Other refusals are waited for until the reply is overdue.
// With engage_at_start, the request is repeated after that, for at most 30 s after the first one.
//
// The operator may engage when datagrams arrive from the slave, the state of the hand is known and, with
// presence = HOLD, a hand is on the handle. Engaging is possible in any state and is the only way out of
// Stopped and Fault. While an engagement is pending or active, another request has no effect.
//
// A tick that comes more than gap_s after the previous tick causes a hold; the last state of the slave is
// discarded, and no engagement is accepted. Round-trip time and late ticks are treated as in
// slave/safety/slave_safety.hpp. The state that the slave reports is used only if it refers to the current
// engagement. A stop is also requested in Fault, until the next engagement.
//
// The cause is the first one since Engaged, with two exceptions: preemption and a restart replace `link silent`, which
// they explain, and a fault or a stop has its own cause. If an engagement is requested but not granted, refusal() returns
// the reason. If this side does not forward the request to the slave, the reason is set immediately.
// Otherwise it is the reason that the slave sends, or `unanswered` if none has arrived 1 s after the
// round-trip time. The reason is kept until another engagement is requested or granted.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/stiffness_report.hpp"
#include "master/config/master_config.hpp"
#include "schema/state_link.hpp"

namespace longreach {

struct MasterSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};  // arrival of the last valid datagram from the slave
  std::uint32_t peer_restarts = 0;   // number of sessions after the first
  bool taken = false;                // true while another master has control of the robot
  bool device_ok = true;
  Reason handle{};          // kHandleJumped in this tick, or kHandleOutside
  bool held = true;         // a hand is on the handle
  bool hand_stale = false;  // true while the input from the hand is too old
  bool engage = false;      // requested in this tick
  bool hold = false;
  bool stop = false;
  std::optional<double> rtt_s{};        // round-trip time of the link; none until it is known
  std::optional<Time> stalled_since{};  // time of the previous tick if it was more than gap_s ago
  bool delay_rose = false;              // the round-trip time has increased by more than delay_rise_max_s
  bool overrun = false;                 // the loop of this side cannot keep its rate
};

class MasterSafety {
 public:
  explicit MasterSafety(const MasterSafetyConfig& config) : config_(config) {}
  void configure(const MasterSafetyConfig& config) { config_ = config; }
  [[nodiscard]] const MasterSafetyConfig& config() const { return config_; }

  /// Processes the state that the slave reports. Call this in the order of arrival.
  void on_report(const StiffnessReport& report);

  /// Advances by one tick. Returns true if an engagement has just been confirmed, so that everything must
  /// start at rest.
  bool step(const MasterSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  [[nodiscard]] bool cause_is_far() const { return far_is_cause_; }  // cause() was reported by the slave
  /// Returns why the last requested engagement was not granted; kNone if it was granted or the reply is
  /// pending.
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  [[nodiscard]] bool refusal_is_far() const { return far_refuses_; }
  [[nodiscard]] SafetyState far_state() const { return far_state_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }
  [[nodiscard]] Request request() const { return request_; }
  /// Returns whether an engagement is requested and the reply is pending.
  [[nodiscard]] bool pending() const { return state_ == SafetyState::kObserving && active(); }
  /// Returns the time until the reply can arrive, s; none if no engagement is pending or the round-trip time
  /// is unknown.
  [[nodiscard]] std::optional<double> answer_in_s(const MasterSafetyInput& in) const;
  [[nodiscard]] bool stale() const { return stale_; }  // no datagram for silence_s
  /// No hand on the handle, although one is required to engage.
  [[nodiscard]] bool hand_missing() const { return hand_missing_; }
  /// Returns the number of holds that ended automatically within resume_s.
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
  void take_cause(const Rule& rule, const MasterSafetyInput& in);
  [[nodiscard]] bool says(SafetyState state) const;
  [[nodiscard]] bool unanswered(const MasterSafetyInput& in) const;
  [[nodiscard]] bool refused() const;
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
  bool restarted_ = false;  // the slave started a new session in this tick
  bool stale_ = false;
  bool hand_missing_ = false;
  bool let_go_ = false;  // no hand has been on the handle for longer than presence_s
  Time held_at_{};       // last time at which a hand was on the handle
  /// The operator has requested an engagement, a hold or a stop, or engage_at_start was processed.
  bool reported_ = false;
  bool confirmed_ = false;                // the slave has confirmed the current engagement
  Time asked_at_{};                       // time of the request for the current engagement
  std::optional<Time> first_asked_at_{};  // time of the first request by engage_at_start
  Time held_since_{};                     // time since which the slave has been reporting Holding
  /// Time at which the current hold began; after a stall, the start of the stall.
  Time left_at_{};
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
