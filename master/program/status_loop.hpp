#pragma once
// The thread besides the loop that writes view and log until the end of the run, with the thread that polls
// the hand.

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

/// A simulated operator at the simulated device; a real device has a real operator.
bool scripted(const MasterConfig& config);

/// Data for the console.
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

/// Lets the simulated operator engage again after a hold caused by the machine or by an outage of the link
/// profile, as a person would: after a second, and every few seconds until it is granted.
class Resumption {
 public:
  /// Returns true to request an engagement now.
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
  /// All must outlive it. Throws std::runtime_error if the library of a pad cannot be loaded.
  StatusLoop(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
             MasterService& service);

  /// The view controls the terminal.
  [[nodiscard]] bool live() const { return view_.live(); }
  /// Returns on `stop`, on request of the user at the keys, or at the end of the run.
  void run(const std::atomic<bool>& stop, const SessionClient& session_client);
  /// Reasons for a released handle, from the first of the run; for its summary.
  [[nodiscard]] const std::vector<HandTrouble>& hand_troubles() const { return troubles_; }

 private:
  [[nodiscard]] double seconds() const { return to_seconds(boottime_now() - began_); }
  /// Holds caused by this machine extend the run, to at most twice its length.
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
  std::string hand_said_;  // the last one; empty when it was over
  Resumption resumption_{};
  Time began_ = boottime_now();
  bool quit_ = false;
};

}  // namespace longreach
