#pragma once
// The safety state machine of the slave, which permits the robot to follow goals. It decides alone, from data of
// this side. One table; the first matching row applies, so the most severe demand takes precedence:
//
//   state                      condition                                  next       cause
//   any                        the robot is not ok                        Fault      robot fault, or the joint
//   any                        the force sensor is implausible            Fault      sensor fault
//   Engaged, Holding, Stopped  the force grows when it should decrease    Fault      sensor sign
//   Holding, Stopped, Fault    the robot moves, its setpoint does not     Fault      uncommanded motion
//   Engaged, Holding, Stopped  the robot does not follow its setpoints    Fault      tracking lost
//   any but Fault              a stop is requested, on either side        Stopped    operator
//   any                        a new engagement is requested              Engaged    -
//   Engaged, Holding           the force does not fall during a retreat,  Holding    force persists, or
//                              or the retreat distance is used up                    surface approaching
//   Engaged                    another master has taken control           Holding    preempted
//   Engaged                    the master started a new session           Holding    peer restarted
//   Engaged                    this tick is later than the gap timer      Holding    stalled
//   Engaged                    silence > gap timer                        Holding    link silent
//   Engaged                    age > age_max_s                            Holding    link stale
//   Engaged                    the round trip rose > delay_rise_max_s     Holding    delay rose
//   Engaged                    half of the ticks of a second were late    Holding    overrun
//   Engaged                    a hold or another number is requested      Holding    peer holds
//   Engaged                    no hand is on the handle                   Holding    handle released
//   Holding                    none of these, and it may end              Engaged    -
//   Idle                       a datagram of the master arrives           Observing  -
//   Observing                  silence > gap timer + resume_s             Idle       -
//
// A new engagement must have a number greater than any used or stopped in this session of the master, come in a
// fresh command (silence and age) that echoes this slave, and find a robot at rest within its limits, a zeroed
// sensor, and no request for a stop on this side. It is the only way out of Stopped and Fault. A refused one has
// a reason while it is requested. A hold may end automatically only if silence, a stall or a released handle
// caused it, within resume_s of the last tick that followed, and if there was no other request for a hold
// meanwhile; the same engagement then resumes. In a tick later than the gap timer after the previous one, only a
// stop is obeyed of the commands that queued up. The round trip, a median of half a second, is compared with its
// minimum since the engagement (common/safety/delay_watch); late ticks are counted as in
// common/safety/overrun_watch. Gap timer: gap_s, or for a master that sends f times a second max(0.1 s, 30/f).
// Setpoints lag the path that they smooth, so the path brakes by that time before the gap timer ends, and the
// setpoint when it ends. Age = now - when this side sent the newest datagram that the master had received: no
// clocks are compared. The cause is the first one since Engaged; a fault has its own, the first of its kind, and
// so has a hold whose force does not fall.

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
  bool taken = false;                     // the newest of them took control from another master
  Reason robot{};                         // why it is not ok: its report, or an implausible joint
  Reason unready{};                       // why no engagement may start with it or its sensor
  bool robot_uncommanded_motion = false;  // it moves although its setpoint is at rest
  bool robot_tracking_lost = false;       // it does not follow its setpoints
  bool sensor_fault = false;              // its force sensor reports an impossible force
  bool sensor_sign = false;               // the force grows along a motion that should reduce it
  bool force_persists = false;            // the force does not respond to a retreat,
  Reason comes{};                         // or it does, but the distance is used up; with its direction
  bool stop = false;                      // requested on this side
  std::optional<Time> stalled_since{};    // time of the previous tick, if longer ago than the gap timer
  bool delay_rose = false;                // the round trip rose by more than delay_rise_max_s
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

  /// One tick. Returns true if a new engagement starts with it.
  bool step(const SlaveSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  /// Engaged, or in a hold: the robot may move, in a hold only to retreat.
  [[nodiscard]] bool follows() const {
    return state_ == SafetyState::kEngaged || state_ == SafetyState::kHolding;
  }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  /// The engagement that is requested but not granted, and the reason; 0: none.
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  /// Engaged, and silence will end that within the setpoint's lag, half the gap timer at most.
  [[nodiscard]] bool brakes() const { return brakes_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }  // followed now or last
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

  /// Age of the data of this side that the master had when it sent its newest command, s; infinite: unknown.
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
  bool restarted_ = false;            // since the start of the engagement
  bool taken_ = false;                // likewise
  Request request_ = Request::kHold;  // of the newest command
  std::uint32_t requested_ = 0;
  std::optional<Time> echo_sent_{};
  Time left_at_{};        // when Engaged ended: for a stall, its start
  bool expired_ = false;  // this hold cannot end automatically
  bool brakes_ = false;
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
