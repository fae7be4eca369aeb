#pragma once
// The thread that polls keyboard and pad for the state of the hand, and passes it with its time to the loop.
// It writes to no terminal, pipe or file, so that a stalled reader cannot block it.

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
    std::string notice;   // notice for the user at the keyboard
    std::string trouble;  // why the hand does not hold the handle, and a remedy
  };

  /// All must outlive it. Other kinds of operator are not polled. Throws std::runtime_error if the library of
  /// a pad cannot be loaded.
  HandPoll(const MasterConfig& config, MasterShell& shell, MasterService& service);
  /// Restores the terminal.
  ~HandPoll();
  HandPoll(const HandPoll&) = delete;
  HandPoll& operator=(const HandPoll&) = delete;

  /// The operator is a keyboard or pad.
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
