#pragma once
// The master's safety machine: which state it is in, why, and which level it requests from the slave.
//
//   Idle       nothing heard yet
//   Observing  the slave is heard; engage() asks for a new engagement and waits for its confirmation
//   Engaged    the slave has confirmed this engagement's number
//   Holding    goals are frozen; ends by itself within resume_s, else by a new engagement
//   Stopped    latched until a new engagement is asked for
//   Fault      device fault; latched until a new engagement is asked for
//
// The most severe demand wins; the first cause is kept.

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "master/master_config.hpp"

namespace longreach {

struct MasterSafetyInput {
  Time now{};
  std::optional<Time> last_heard{};  // any valid datagram of the slave
  std::uint32_t peer_restarts = 0;   // sessions of the slave after its first
  bool device_ok = true;
  bool engage = false;  // asked for in this tick
  bool hold = false;
  bool stop = false;
};

class MasterSafety {
 public:
  explicit MasterSafety(const MasterSafetyConfig& config) : config_(config) {}
  void configure(const MasterSafetyConfig& config) { config_ = config; }

  /// What the slave says of itself, in the order of arrival.
  void on_report(const StiffnessReport& report);

  /// One tick. True if an engagement has just been confirmed: everything begins at rest.
  bool step(const MasterSafetyInput& input);

  [[nodiscard]] SafetyState state() const { return state_; }
  [[nodiscard]] HoldCause cause() const { return cause_; }
  [[nodiscard]] SafetyState far_state() const { return far_state_; }
  [[nodiscard]] std::uint32_t engagement() const { return engagement_; }
  [[nodiscard]] Request request() const { return request_; }
  [[nodiscard]] bool stale() const { return stale_; }  // nothing heard for silence_s
  [[nodiscard]] std::uint64_t false_holds() const { return false_holds_; }

 private:
  void leave(SafetyState state, HoldCause cause, Time now);
  void follow_slave(Time now);

  MasterSafetyConfig config_;
  SafetyState state_ = SafetyState::kIdle;
  HoldCause cause_ = HoldCause::kNone;
  Request request_ = Request::kHold;
  std::uint32_t engagement_ = 0;
  SafetyState far_state_ = SafetyState::kIdle;
  HoldCause far_cause_ = HoldCause::kNone;
  std::uint32_t far_engagement_ = 0;
  std::uint32_t peer_restarts_ = 0;
  bool stale_ = false;
  bool engaged_once_ = false;  // engage_at_start has been used
  bool confirmed_ = false;     // the present engagement was confirmed
  Time left_at_{};             // when Engaged was left
  std::uint64_t false_holds_ = 0;
};

}  // namespace longreach
