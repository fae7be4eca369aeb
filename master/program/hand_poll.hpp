#pragma once
// The thread that asks keyboard and pad what the hand does, and hands it to the loop with its time. It writes
// to no terminal, pipe or file, so that nobody who does not read can hold it up.

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "master/input/keyboard.hpp"
#include "master/input/pad_operator.hpp"
#include "master/program/master_service.hpp"

namespace longreach {

class HandPoll {
 public:
  /// For the view.
  struct Seen {
    bool show_keys = false;
    bool quit = false;  // latched
    std::string pad_keys;
    std::string notice;   // what the person at the keyboard should know
    std::string trouble;  // why there is nothing in the hand, and what to do
  };

  /// All must outlive it. Nobody to ask for other kinds of operator. Throws std::runtime_error where the
  /// library of a pad cannot be loaded.
  HandPoll(const MasterConfig& config, MasterShell& shell, MasterService& service);
  /// Gives the terminal back.
  ~HandPoll();
  HandPoll(const HandPoll&) = delete;
  HandPoll& operator=(const HandPoll&) = delete;

  /// Keyboard or pad is the hand.
  [[nodiscard]] bool is_hand() const { return keyboard_.has_value(); }
  [[nodiscard]] Seen seen() const;

 private:
  void run();
  void poll();
  OperatorRequests poll_pad(const MasterView& view, OperatorRequests keys);

  const MasterConfig& config_;
  MasterShell& shell_;
  MasterService& service_;
  std::optional<Keyboard> keyboard_;
  std::optional<PadOperator> pad_;
  Time polled_{};
  mutable std::mutex seeing_;
  Seen seen_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
