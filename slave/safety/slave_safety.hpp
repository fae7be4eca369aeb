#pragma once
// The slave's safety machine: may the robot follow goals? It acts alone, on what this side knows. One table;
// the first row that applies is taken, so the most severe demand wins:
//
//   state                      condition                                 next       cause
//   any                        the robot is not ok                       Fault      robot fault, or which joint
//   any                        the force sensor says what no contact does  Fault    force sensor fault
//   Engaged, Holding, Stopped  a force grows by what should relieve it   Fault      force sensor sign
//   Holding, Stopped, Fault    the robot moves on, its setpoint does not  Fault     robot does not rest
//   Engaged, Holding, Stopped  the robot is not where its setpoints lead  Fault     robot does not follow
//   any but Fault              a stop is asked for, on either side       Stopped    operator
//   any                        a new engagement is asked for             Engaged    -
//   Engaged, Holding           the force does not fall as the robot      Holding    no relief, or wall comes
//                              gives way, or the way is used up
//   Engaged                    another master has taken control of the robot        Holding    taken by another master
//   Engaged                    the master began a new session            Holding    other side restarted
//   Engaged                    this tick came later than the gap timer   Holding    stalled
//   Engaged                    silence > gap timer                       Holding    link silent
//   Engaged                    age > age_max_s                           Holding    link stale
//   Engaged                    the round trip rose > delay_rise_max_s    Holding    delay rose
//   Engaged                    half of a second's ticks came late        Holding    overrun
//   Engaged                    a hold or another number is asked for     Holding    peer holds
//   Engaged                    no hand is on the handle                  Holding    handle let go
//   Holding                    none of these, and it may end             Engaged    -
//   Idle                       the master is heard                       Observing  -
//   Observing                  silence > gap timer + resume_s            Idle       -
//
// A new engagement has a number greater than any used or stopped in this session of the master, comes
// in a command that is fresh (silence and age) and echoes this slave, and finds a robot that rests within its
// limits, a sensor that is zeroed, and nobody on this side who asks for a stop. It is the only way out of
// Stopped and Fault. One that is not granted has a reason, as long as it is asked for. A hold may end by
// itself only if silence, a stall or a released handle was its cause, within resume_s of the last tick that
// followed, and if nothing else asked for a hold meanwhile; the same engagement then goes on. A tick that
// comes later than the gap timer after the one before obeys what lay there meanwhile in one thing alone: a
// stop. The round trip, a median of half a second, is compared with its least since the engagement
// (common/safety/delay_watch); ticks are late as common/safety/overrun_watch counts them. Gap timer: gap_s, or of
// a master that sends f times a second max(0.1 s, 30/f). Setpoints come later than the path that they smooth,
// so the path brakes that much before the gap timer ends, and the setpoint when it does. Age = now - when
// this side had sent what the master last heard: no clocks are compared. The cause is the first since
// Engaged; a fault has its own, the first of its kind, and so has a hold whose force does not fall.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

struct SlaveSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};       // any valid datagram
  std::uint32_t peer_session_count = 0;   // sessions of the master seen so far
  bool taken = false;                     // the newest of them by taking the robot from another master
  Reason robot{};                         // why it is not ok: it says so, or which joint is not believed
  Reason unready{};                       // why no engagement may begin with it or its sensor
  bool robot_uncommanded_motion = false;  // it moves on though its setpoint rests
  bool robot_tracking_lost = false;       // it is not where its setpoints lead
  bool sensor_fault = false;              // its force sensor says what no contact could do
  bool sensor_sign = false;               // the force grows along what should relieve it
  bool force_persists = false;            // the force does not answer to relief,
  Reason comes{};                         // or it does, the way is used up, and where it comes from
  bool stop = false;                      // asked for on this side
  std::optional<Time> stalled_since{};    // the tick before, where it is longer ago than the gap timer
  bool delay_rose = false;                // the round trip, by more than delay_rise_max_s
  bool overrun = false;                   // this side does not keep its rate
  double send_hz = 300.0;                 // of the master
  double lag_s = 0.0;                     // of the setpoint behind the path

  // The newest command, if one came in this tick.
  bool commanded = false;
  std::uint32_t engagement = 0;
  Request request = Request::kHold;
  std::optional<Time> echo_sent{};
};

class SlaveSafety {
 public:
  explicit SlaveSafety(const SlaveSafetyConfig& config) : config_(config) {}
  void configure(const SlaveSafetyConfig& config) { config_ = config; }
  [[nodiscard]] const SlaveSafetyConfig& config() const { return config_; }

  /// One tick. True if a new engagement begins with it.
  bool step(const SlaveSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  /// Engaged, or in a hold: the robot moves by itself, if only to give way.
  [[nodiscard]] bool follows() const {
    return state_ == SafetyState::kEngaged || state_ == SafetyState::kHolding;
  }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  /// The engagement that is asked for and not granted, and why; 0: none.
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  /// Engaged, and silence will end that within the setpoint's lag, half the gap timer at most.
  [[nodiscard]] bool brakes() const { return brakes_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }  // followed now or last
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

  /// Age of what the master knew of this side when it sent its newest command, s; infinite: not known.
  [[nodiscard]] double news_age_s(Time now) const;

 private:
  enum class Demand : std::uint8_t;
  struct Rule;
  static const Rule kTable[];

  void observe(const SlaveSafetyInput& in);
  [[nodiscard]] bool demanded(Demand demand, const SlaveSafetyInput& in) const;
  [[nodiscard]] static bool asks(const SlaveSafetyInput& in);
  [[nodiscard]] Reason why_not(const SlaveSafetyInput& in) const;
  [[nodiscard]] bool goes_on(const SlaveSafetyInput& in) const;
  [[nodiscard]] bool silent(const SlaveSafetyInput& in, double longer_s = 0.0) const;
  void expire(const SlaveSafetyInput& in);
  void enter(const Rule& rule, const SlaveSafetyInput& in);

  SlaveSafetyConfig config_;
  SafetyState state_ = SafetyState::kIdle;
  Reason cause_{};
  Reason refusal_{};
  std::uint32_t refused_ = 0;
  std::uint32_t engagement_ = 0;
  std::uint32_t used_ = 0;  // greatest number accepted or stopped in this session of the peer
  std::uint32_t sessions_ = 0;
  bool restarted_ = false;            // since the engagement began
  bool taken_ = false;                // likewise
  Request request_ = Request::kHold;  // of the newest command
  std::uint32_t requested_ = 0;
  std::optional<Time> echo_sent_{};
  Time left_at_{};        // when Engaged was left: of a stall, when it began
  bool expired_ = false;  // this hold cannot end by itself
  bool brakes_ = false;
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
