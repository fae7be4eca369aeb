#pragma once
// The safety state machine of the slave. It decides when the robot may follow goals, using only data from
// this side. The first matching row of the table applies, so the most severe demand takes precedence:
//
//   state                      condition                                  next       cause
//   any                        the robot is not ok                        Fault      robot or joint fault
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
//   Engaged                    no datagram for longer than the gap timer  Holding    link silent
//   Engaged                    age > age_max_s                            Holding    link stale
//   Engaged                    the round trip rose > delay_rise_max_s     Holding    delay rose
//   Engaged                    half of the ticks of a second were late    Holding    overrun
//   Engaged                    a hold or another number is requested      Holding    peer holds
//   Engaged                    the operator has released the handle       Holding    handle released
//   Holding                    none of these, and the hold may end        Engaged    -
//   Idle                       a datagram of the master arrives           Observing  -
//   Observing                  none for the gap timer + resume_s          Idle       -
//
// A new engagement requires a number greater than any that was used or stopped in this session of the master,
// a fresh command (by gap timer and age) that echoes a datagram of this slave, a robot at rest within its
// limits, a zeroed sensor, and no request for a stop on this side. A new engagement is the only way out of
// Stopped and Fault. While a request for an engagement is refused, the reason is reported. A refusal because of
// a fault uses up the number (common/safety/ended_request.hpp): the engagement does not start when the fault
// ends.
//
// A hold may end automatically only if it was caused by missing datagrams, a stall or a released handle, only
// within resume_s after the last tick in which the goals were followed, and only if no other reason for a
// hold occurred in between. The same engagement then resumes. The third hold because of missing datagrams
// within 10 s of the same engagement stays: datagrams that arrive in bursts, as with the power saving of
// Wi-Fi, would otherwise stop and start the robot at the rate of the bursts. In a tick that is later than the gap timer,
// several commands may have queued up; of these, only a stop is executed.
//
// The round-trip time (median over half a second) is compared with its minimum since the engagement
// (common/safety/delay_watch); late ticks are counted as in common/safety/overrun_watch. The timeout of the
// gap timer is gap_s or, by default, 30/f limited to 0.1 to 2 s for a master that sends f times per second.
// The setpoint lags the path. The path therefore starts to brake before the gap timer ends, earlier by that
// lag, and the setpoint starts to brake when the timer ends. Age = now - the time at which this side sent the
// newest datagram that the master had received; clocks of the two sides are not compared. The reported cause
// is the first one since Engaged, with two exceptions: a fault has its own cause (the first fault), and so
// does a hold in which the force does not decrease.

#include <array>
#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/stiffness_report.hpp"
#include "schema/state_link.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

struct SlaveSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};      // arrival of the last valid datagram
  std::uint32_t peer_session_count = 0;  // number of master sessions so far
  /// True if the newest session took control from another master.
  bool taken = false;
  /// Reason why the robot is not ok: its own report or an implausible joint.
  Reason robot{};
  /// Reason, related to the robot or its sensor, why no engagement may start.
  Reason unready{};
  bool robot_uncommanded_motion = false;  // the robot moves although its setpoint is at rest
  bool robot_tracking_lost = false;       // the robot does not follow its setpoints
  bool sensor_fault = false;              // the force sensor reports an impossible force
  bool sensor_sign = false;               // the force grows during a motion that should reduce it
  bool force_persists = false;  // the force does not respond to a retreat, or the retreat distance is used up
  /// Set if the force responds to a retreat, which means that a surface is approaching; contains its
  /// direction.
  Reason comes{};
  bool stop = false;  // a stop is requested on this side
  /// Time of the previous tick, if this tick is later than the gap timer.
  std::optional<Time> stalled_since{};
  bool delay_rose = false;  // the round-trip time rose by more than delay_rise_max_s
  bool overrun = false;     // this side does not keep up with its tick rate
  double send_hz = 300.0;   // send rate of the master
  double lag_s = 0.0;       // lag of the setpoint behind the path

  // The newest command and whether one arrived in this tick.
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

  /// Processes one tick. Returns true if a new engagement starts in this tick.
  bool step(const SlaveSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  /// True if the robot may move: it follows the goals in Engaged and only retreats in a hold.
  [[nodiscard]] bool follows() const {
    return state_ == SafetyState::kEngaged || state_ == SafetyState::kHolding;
  }
  [[nodiscard]] const Reason& cause() const { return cause_; }
  /// Number of the engagement that is requested but not granted; 0 if there is none. refusal() returns the
  /// reason.
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] const Reason& refusal() const { return refusal_; }
  /// Number of the last engagement that was refused for good (0: none), and the reason. The master withdraws such a
  /// request at once, so that refused() shows it only briefly.
  [[nodiscard]] std::uint32_t ended() const { return ended_; }
  [[nodiscard]] const Reason& ended_because() const { return ended_because_; }
  /// True if the setpoint path must brake because the gap timer ends within the lag of the setpoint (at most
  /// half the gap timer).
  [[nodiscard]] bool brakes() const { return brakes_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }  // current or last engagement
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

  /// Age of the newest data from this side that the master had when it sent its newest command, s; infinite
  /// if unknown.
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
  void count_silence(const SlaveSafetyInput& in);
  void enter(const Rule& rule, const SlaveSafetyInput& in);

  SlaveSafetyConfig config_;
  SafetyState state_ = SafetyState::kIdle;
  Reason cause_{};
  Reason refusal_{};
  std::uint32_t refused_ = 0;
  std::uint32_t engagement_ = 0;
  std::uint32_t used_ = 0;   // highest number that was accepted, stopped or refused for good in this session
  std::uint32_t ended_ = 0;  // number of the last engagement that was refused for good
  Reason ended_because_{};
  std::uint32_t sessions_ = 0;
  /// True if the master has started a new session since the start of the engagement.
  bool restarted_ = false;
  /// True if another master has taken control since the start of the engagement.
  bool taken_ = false;
  Request request_ = Request::kHold;  // request of the newest command
  std::uint32_t requested_ = 0;
  std::optional<Time> echo_sent_{};
  /// Time at which Engaged ended; for a stall, the start of the stall.
  Time left_at_{};
  bool expired_ = false;  // this hold cannot end automatically
  /// Begin of the last two holds of this engagement because of missing datagrams, newest first.
  std::array<std::optional<Time>, 2> silences_{};
  bool brakes_ = false;
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
