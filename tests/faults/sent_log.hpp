#pragma once
// What the master really sent, and when; what of it the slave was given, and when. It was written down
// outside of both. From it follows whether anything may move the robot: the right to move.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "common/link/envelope.hpp"
#include "common/link/motion_command.hpp"

namespace longreach {

struct SentCommand {
  double t_s = 0.0;
  std::uint64_t session = 0;
  std::uint64_t sequence = 0;
  MotionCommand command{};
};

/// Whether the newest command that the slave was given lets the robot move.
struct MotionAuthority {
  bool engaged = false;      // it asks for this engagement, and nothing has ended that since
  double received_s = -1e9;  // when the newest command came
  double sent_s = -1e9;      // when it had left
  double had_s = -1e9;       // when it was there last
  std::uint32_t engagement = 0;
  Request request = Request::kHold;
  const SentCommand* newest = nullptr;
};

class SentLog {
 public:
  /// Times of the slave's safety: it holds after the one, and goes on by itself within the other.
  SentLog(double gap_s, double resume_s) : gap_s_(gap_s), resume_s_(resume_s) {}

  /// From now on the slave follows this session, and the master too if it was handed to it.
  void lease(double t_s, std::uint64_t session, bool to_master);
  void master_sent(double t_s, std::uint64_t sequence, const MotionCommand& command);
  /// The operator asked for an engagement: the next number that the master sends is one.
  void asked() { ++asks_; }

  /// Judges what the slave was given as commands. False: one of them nobody sent so, or its number does not
  /// rise, or it is of another session.
  /// `slept_s`: between this tick of the slave and the one before. What lay there meanwhile is not heard now,
  /// but for a stop.
  bool slave_given(double t_s, double slept_s, std::span<const Received<MotionCommand>> commands);
  [[nodiscard]] std::uint32_t ended() const { return ended_; }  // engagements up to this one are over
  /// The slave says that it is engaged in it: a long silence from now on ends it. One that has not come about
  /// may wait.
  void entered(std::uint32_t engagement) { entered_ = std::max(entered_, engagement); }
  /// Something at the slave ended every engagement there was.
  void ended(double t_s);

  [[nodiscard]] const MotionAuthority& authority() const { return authority_; }
  [[nodiscard]] std::uint64_t given() const { return given_; }
  [[nodiscard]] std::uint64_t asks() const { return asks_; }
  [[nodiscard]] const std::deque<SentCommand>& sent() const { return sent_; }
  /// Greatest engagement that the master has sent.
  [[nodiscard]] std::uint32_t numbers() const { return numbers_; }

 private:
  void obey(double t_s, const SentCommand& sent, bool slept);
  [[nodiscard]] const SentCommand* find(std::uint64_t sequence) const;

  double gap_s_, resume_s_;
  std::uint64_t session_ = 1, master_session_ = 1;
  std::deque<SentCommand> sent_;  // numbers rise
  std::uint64_t newest_ = 0;
  std::uint32_t ended_ = 0;  // engagements up to this one are over
  std::uint32_t entered_ = 0;
  std::uint32_t numbers_ = 0;
  std::uint64_t asks_ = 0, given_ = 0;
  MotionAuthority authority_{};
};

}  // namespace longreach
