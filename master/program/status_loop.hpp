#pragma once
// The thread beside the loop: view and log out, until the run is over; beside it the one that asks the hand.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "common/loop/real_time_loop.hpp"
#include "common/program/service_watch.hpp"
#include "common/rpc/session_client.hpp"
#include "master/console/hold_log.hpp"
#include "master/console/terminal_view.hpp"
#include "master/program/hand_poll.hpp"
#include "master/program/master_service.hpp"

namespace longreach {

/// A simulated person at the simulated device; a real device has a real one.
bool scripted(const MasterConfig& config);

/// What the console shows of it.
ConsoleSnapshot picture(const MasterSnapshot& s, const MasterConfig& config);

/// Logs what has changed since the last call.
class StateLog {
 public:
  void write(const MasterSnapshot& s, const std::string& trouble, const std::string& hand_trouble);
  void write_notice(const std::string& notice);

 private:
  MasterSnapshot last_{};
  std::string trouble_, hand_trouble_, notice_;
};

/// The simulated operator engages again after a hold that the machine or an outage of the link's profile
/// caused, as a person would: after a second, and every few seconds while that is not answered.
class Resumption {
 public:
  /// True: ask for an engagement now.
  bool step(double seconds, const MasterView& view, const HoldLog& holds);

 private:
  double ask_s_ = 0.0;
};

struct RunOptions {
  ViewKind view = ViewKind::kAuto;
  std::optional<double> seconds{};  // length of the run; none: until it is ended
};

class StatusLoop {
 public:
  /// All must outlive it. Throws std::runtime_error where the library of a pad cannot be loaded.
  StatusLoop(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
             MasterService& service);

  /// The view owns the terminal.
  [[nodiscard]] bool live() const { return view_.live(); }
  /// Returns when `stop`, the person at the keys or the length of the run says so.
  void run(const std::atomic<bool>& stop, const SessionClient& session_client);
  /// Why there was nothing in the hand, the first of the run; for its summary.
  [[nodiscard]] const std::vector<HandTrouble>& hand_troubles() const { return troubles_; }

 private:
  [[nodiscard]] double seconds() const { return to_seconds(boottime_now() - began_); }
  /// Holds that this machine caused extend it, to twice its length at most.
  [[nodiscard]] double length_s() const;
  [[nodiscard]] std::string hand_trouble(const MasterSnapshot& s) const;
  void note(const std::string& hand);

  RunOptions options_;
  const MasterConfig& config_;
  MasterService& service_;
  TerminalView view_;
  std::optional<HandPoll> hand_;
  StateLog state_log_;
  ServiceWatch watch_;
  HoldLog holds_;
  std::vector<HandTrouble> troubles_;
  std::string hand_said_;  // the last one, empty when it was over
  Resumption resumption_{};
  Time began_ = boottime_now();
  bool quit_ = false;
};

}  // namespace longreach
