#pragma once
// The thread that polls keyboard and pad, and passes the state of the hand, with the time of the poll, to the
// loop. It writes to no terminal, pipe or file, so that a stalled reader cannot block it.

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
  /// Data for the console.
  struct Seen {
    bool show_keys = false;
    bool quit = false;  // latched
    std::string pad_keys;
    std::string notice;   // notice for the user at the keyboard; empty if there is none
    std::string trouble;  // why the hand does not hold the handle, and a remedy; empty if it does
  };

  /// Starts polling if the configured operator is a keyboard or a pad. The arguments must outlive this
  /// object. Throws std::runtime_error if the library for a pad cannot be loaded.
  HandPoll(const MasterConfig& config, MasterShell& shell, MasterService& service);
  /// Stops polling and restores the terminal.
  ~HandPoll();
  HandPoll(const HandPoll&) = delete;
  HandPoll& operator=(const HandPoll&) = delete;

  /// Returns whether the operator is a keyboard or pad.
  [[nodiscard]] bool is_hand() const { return keyboard_.has_value(); }
  /// Returns the result of the last poll; callable from any thread.
  [[nodiscard]] Seen seen() const;

 private:
  void run();
  void poll();
  OperatorRequests poll_pad(const MasterView& view, OperatorRequests keys, double since_s);

  const MasterConfig& config_;
  MasterShell& shell_;
  MasterService& service_;
  std::optional<Keyboard> keyboard_;
  std::optional<PadOperator> pad_;
  Time polled_{};
  std::uint32_t begun_ = 0;  // number of the last change of hands from which keyboard and pad began
  mutable std::mutex seeing_;
  Seen seen_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
