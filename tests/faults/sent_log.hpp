#pragma once
// Records, independently of the two sides, what the master sent and what the slave received, with times. The
// record determines whether the robot is permitted to move.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "common/link/envelope.hpp"
#include "schema/state_link.hpp"

namespace longreach {

struct SentCommand {
  double t_s = 0.0;
  std::uint64_t session = 0;
  std::uint64_t sequence = 0;
  MotionCommand command{};
};

/// Permission to move the robot, derived from the commands that the slave received.
struct MotionAuthority {
  /// True if the newest command requests this engagement and the engagement has not ended.
  bool engaged = false;
  double received_s = -1e9;  // arrival of the newest command
  double sent_s = -1e9;      // time at which that command was sent
  /// Last time at which the robot was permitted to move.
  double had_s = -1e9;
  std::uint32_t engagement = 0;
  Request request = Request::kHold;
  const SentCommand* newest = nullptr;
};

class SentLog {
 public:
  /// `gap_s` and `resume_s` are parameters of the slave's safety state machine. The slave holds after `gap_s`
  /// without a datagram and may resume automatically within `resume_s`.
  SentLog(double gap_s, double resume_s) : gap_s_(gap_s), resume_s_(resume_s) {}

  /// From now on the slave follows `session`; if `to_master`, the master uses this session as well.
  void lease(double t_s, std::uint64_t session, bool to_master);
  void master_sent(double t_s, std::uint64_t sequence, const MotionCommand& command);
  /// Call this when the operator has requested an engagement; the next new number from the master may then
  /// start an engagement.
  void asked() { ++asks_; }

  /// Checks the commands that the slave received. Returns false if a command was not sent in this form, has a
  /// number that does not increase, or belongs to another session. `slept_s` is the time between the previous
  /// tick of the slave and this one. If it exceeds the gap timer, all queued commands except a stop are
  /// ignored.
  bool slave_given(double t_s, double slept_s, std::span<const Received<MotionCommand>> commands);
  [[nodiscard]] std::uint32_t ended() const { return ended_; }  // engagements up to this number have ended
  /// Call this when the slave reports that it is in this engagement. From then on, a long time without
  /// datagrams ends the engagement; before that, it does not.
  void entered(std::uint32_t engagement) { entered_ = std::max(entered_, engagement); }
  /// Call this when an event at the slave has ended all engagements up to now.
  void ended(double t_s);

  [[nodiscard]] const MotionAuthority& authority() const { return authority_; }
  [[nodiscard]] std::uint64_t given() const { return given_; }
  [[nodiscard]] std::uint64_t asks() const { return asks_; }
  [[nodiscard]] const std::deque<SentCommand>& sent() const { return sent_; }
  /// Highest engagement number that the master has sent.
  [[nodiscard]] std::uint32_t numbers() const { return numbers_; }

 private:
  void obey(double t_s, const SentCommand& sent, bool slept);
  [[nodiscard]] const SentCommand* find(std::uint64_t sequence) const;

  double gap_s_, resume_s_;
  std::uint64_t session_ = 1, master_session_ = 1;
  std::deque<SentCommand> sent_;  // ordered by sequence number
  std::uint64_t newest_ = 0;
  std::uint32_t ended_ = 0;  // engagements up to this number have ended
  std::uint32_t entered_ = 0;
  std::uint32_t numbers_ = 0;
  std::uint64_t asks_ = 0, given_ = 0;
  MotionAuthority authority_{};
};

}  // namespace longreach
