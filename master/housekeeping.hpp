#pragma once
// The thread beside the loop: keys and pads in, view and log out, until the run is over.

#include <atomic>
#include <optional>
#include <string>

#include "common/io/real_time_loop.hpp"
#include "common/io/session_seeker.hpp"
#include "master/console/keyboard.hpp"
#include "master/console/terminal_view.hpp"
#include "master/drivers/pad_operator.hpp"
#include "master/master_service.hpp"

namespace longreach {

/// A simulated person at the simulated device; a real device has a real one.
bool scripted(const MasterConfig& config);

/// What the console shows of it.
ConsoleSnapshot picture(const MasterSnapshot& s, const MasterConfig& config);

/// Logs what has changed since the last call.
class Chronicle {
 public:
  void write(const MasterSnapshot& s, const std::string& trouble, const std::string& hand_trouble);

 private:
  MasterSnapshot last_{};
  std::string trouble_, hand_trouble_;
};

struct RunOptions {
  ViewKind view = ViewKind::kAuto;
  std::optional<double> seconds{};  // length of the run; none: until it is ended
};

class Housekeeping {
 public:
  /// All must outlive it. Throws std::runtime_error where the library of a pad cannot be loaded.
  Housekeeping(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
               MasterService& service);

  /// The view owns the terminal.
  [[nodiscard]] bool live() const { return view_.live(); }
  /// Returns when `stop`, the person at the keys or the length of the run says so.
  void run(const std::atomic<bool>& stop, const SessionSeeker& seeker);

 private:
  [[nodiscard]] double seconds() const { return to_seconds(monotonic_now() - began_); }
  [[nodiscard]] std::string hand_trouble(const MasterSnapshot& s) const;
  bool poll_hand(const MasterView& view);

  RunOptions options_;
  const MasterConfig& config_;
  MasterShell& shell_;
  MasterService& service_;
  TerminalView view_;
  std::optional<Keyboard> keyboard_;
  std::optional<PadOperator> pad_;
  double polled_s_ = 0.0;
  Chronicle chronicle_;
  Time began_ = monotonic_now();
  bool quit_ = false;
};

}  // namespace longreach
