#pragma once
// Passes one command at a time from any thread to the loop, and returns its reply. The loop side (take,
// answer) uses only a few atomic operations: it never waits, locks or wakes a thread. The posting side polls
// for the reply.

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace longreach {

template <class Command, class Reply>
class Mailbox {
 public:
  /// Passes a command to the loop and waits for the reply. Returns none if the loop did not take the command
  /// within `timeout`; the command is then never taken.
  std::optional<Reply> post(Command command, std::chrono::milliseconds timeout) {
    const std::lock_guard lock(posting_);
    const Emptied emptied{command_};
    command_ = std::move(command);
    state_.store(State::kPosted, std::memory_order_release);
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (state_.load(std::memory_order_acquire) != State::kAnswered) {
      State posted = State::kPosted;
      const bool late = std::chrono::steady_clock::now() >= deadline;
      // Once a command is taken, the reply follows within a tick.
      if (late && state_.compare_exchange_strong(posted, State::kEmpty)) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    const Reply reply = reply_;
    state_.store(State::kEmpty, std::memory_order_relaxed);
    return reply;
  }

  /// Loop side: returns the pending command, or null. It must be answered before the next take().
  const Command* take() {
    State posted = State::kPosted;
    return state_.compare_exchange_strong(posted, State::kTaken, std::memory_order_acq_rel) ? &command_
                                                                                            : nullptr;
  }
  /// Loop side: returns `reply` to the thread that posted the command.
  void answer(const Reply& reply) {
    reply_ = reply;
    state_.store(State::kAnswered, std::memory_order_release);
  }

 private:
  /// Erases the command at the end of post(), because it may contain the secret of a session.
  struct Emptied {
    Command& command;
    ~Emptied() { command = Command{}; }
  };
  enum class State { kEmpty, kPosted, kTaken, kAnswered };

  std::mutex posting_;  // serialises the posting threads
  std::atomic<State> state_{State::kEmpty};
  Command command_{};
  Reply reply_{};
};

}  // namespace longreach
