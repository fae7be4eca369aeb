#pragma once
// The slave's safety machine: may the robot follow goals? It acts alone, on what this side knows.
//
//   state      leaves to     when
//   any        Fault         the robot is not ok
//   any        Stopped       stop is asked for, from either side
//   Idle       Observing     the master is heard
//   Observing  Idle          silence of gap_s + resume_s
//   any but Idle  Engaged    a new engagement is accepted (see below)
//   Engaged    Holding       hold asked for, peer restarted, silence > gap_s, age > age_max_s
//   Holding    Engaged       the hold was by silence, at most resume_s long, and the same engagement is still
//   asked for
//
// An engagement is accepted when the newest command asks for a number greater than any used in this session
// of the peer, and carries an echo: the master has heard this slave. It is the only way out of Stopped, and,
// once the robot is ok again, of Fault. Age = now - when this side had sent what the master last heard: no
// clocks are compared. The most severe demand wins; the first cause of leaving Engaged is kept until the next
// engagement.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "slave/slave_config.hpp"

namespace longreach {

struct SlaveSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};      // any valid datagram
  std::uint32_t peer_session_count = 0;  // sessions of the master seen so far
  bool robot_ok = true;                  // it says so and its state is finite
  bool stop = false;                     // asked for on this side

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

  /// One tick. True if a new engagement begins with it.
  bool step(const SlaveSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  [[nodiscard]] HoldCause cause() const { return cause_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }  // followed now or last
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

 private:
  void observe_session(const SlaveSafetyInput& in);
  [[nodiscard]] bool accepts(const SlaveSafetyInput& in) const;
  [[nodiscard]] HoldCause demand(const SlaveSafetyInput& in) const;
  void leave(SafetyState state, HoldCause cause, Time now);
  void resume(const SlaveSafetyInput& in);

  SlaveSafetyConfig config_;
  SafetyState state_ = SafetyState::kIdle;
  HoldCause cause_ = HoldCause::kNone;
  std::uint32_t engagement_ = 0;
  std::uint32_t used_ = 0;  // greatest number accepted or stopped in this session of the peer
  std::uint32_t sessions_ = 0;
  bool restarted_ = false;
  Request request_ = Request::kHold;  // of the newest command
  std::uint32_t requested_ = 0;
  std::optional<Time> echo_sent_{};
  Time left_at_{};        // when Engaged was left
  bool expired_ = false;  // this hold cannot end by itself
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
