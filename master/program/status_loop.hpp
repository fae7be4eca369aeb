#pragma once
// Updates the view and the log until the end of the run, in a thread other than the loop thread. It also owns
// the thread that polls the hand.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "common/loop/real_time_loop.hpp"
#include "common/program/service_watch.hpp"
#include "common/rpc/session_client.hpp"
#include "master/console/hold_log.hpp"
#include "master/console/situation_watch.hpp"
#include "master/console/terminal_view.hpp"
#include "master/program/hand_poll.hpp"
#include "master/program/master_service.hpp"

namespace longreach {

/// Returns whether the operator is a script, which requires a simulated device: a real device has a real
/// operator.
bool scripted(const MasterConfig& config);

/// Returns the data for the console.
ConsoleSnapshot picture(const MasterSnapshot& s, const MasterConfig& config);

/// Logs the changes of state since the previous call.
class StateLog {
 public:
  void write(const MasterSnapshot& s, const std::string& trouble, const std::string& hand_trouble);
  void write_notice(const std::string& notice);
  void write_situation(const Shown& shown);

 private:
  MasterSnapshot last_{};
  std::string trouble_, hand_trouble_, notice_;
  std::optional<Situation> situation_{};
};

/// Makes the simulated operator engage again after a hold caused by the machine or by an outage in the link
/// profile, as a person would: after one second, and then every few seconds until the engagement is granted.
class Resumption {
 public:
  /// Returns whether to request an engagement now. `seconds` is the time since the start of the run.
  bool step(double seconds, const MasterView& view, const HoldLog& holds);

 private:
  double ask_s_ = 0.0;
};

struct RunOptions {
  ViewKind view = ViewKind::kAuto;
  std::optional<double> seconds{};  // length of the run; none: unlimited
};

class StatusLoop {
 public:
  /// The arguments must outlive this object. Throws std::runtime_error if the library for a pad cannot be
  /// loaded.
  StatusLoop(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
             MasterService& service);

  /// When the run began; all its times count from then.
  [[nodiscard]] Time began() const { return began_; }
  /// Returns whether the view controls the terminal.
  [[nodiscard]] bool live() const { return view_.live(); }
  /// Runs until `stop` is true, the user presses the quit key, or the run ends.
  void run(const std::atomic<bool>& stop, const SessionClient& session_client);
  /// Returns the reasons why the handle counted as released during the run, in chronological order, for the
  /// summary.
  [[nodiscard]] const std::vector<HandTrouble>& hand_troubles() const { return troubles_; }

 private:
  [[nodiscard]] double seconds() const { return to_seconds(boottime_now() - began_); }
  /// Length of the run, s. Holds caused by this machine extend it to at most twice the requested length.
  [[nodiscard]] double length_s() const;
  [[nodiscard]] std::string hand_trouble(const MasterSnapshot& s) const;
  void note(const std::string& hand);

  RunOptions options_;
  const MasterConfig& config_;
  MasterService& service_;
  TerminalView view_;
  std::optional<HandPoll> hand_;
  SituationWatch situations_;
  StateLog state_log_;
  ServiceWatch watch_;
  HoldLog holds_;
  std::vector<HandTrouble> troubles_;
  std::string hand_said_;  // the current problem with the input of the hand; empty if there is none
  Resumption resumption_{};
  Time began_ = boottime_now();
  bool quit_ = false;
};

}  // namespace longreach
