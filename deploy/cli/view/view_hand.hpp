#pragma once
// Forwards the hand pose from a page to the master. A thread sends each new target (HandAim) once, over the
// RPC Hold; if targets arrive faster than they can be sent, only the newest is sent. If the page stops
// sending, nothing is sent, and the master detects the timeout.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "deploy/cli/invocation.hpp"
#include "proto/control.pb.h"

namespace grpc {
class ClientContext;
}

namespace longreach {

class ViewHand {
 public:
  /// `refused` is called with the reason if the master refuses control by the page.
  ViewHand(const Options& options, std::function<void(const std::string&)> refused);
  ~ViewHand();
  ViewHand(const ViewHand&) = delete;
  ViewHand& operator=(const ViewHand&) = delete;

  // These functions may be called from any thread and do not block.
  void aim(const proto::HandAim& aim);
  /// Ends the stream. If `lost`, the stream is cancelled instead of closed, so that the robot holds.
  void let_go(bool lost);

 private:
  enum class Going { kNone, kOrderly, kLost };

  void run();
  void hold();
  std::optional<proto::HandAim> next(Going& going);

  const Options options_;
  const std::function<void(const std::string&)> refused_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<proto::HandAim> newest_;
  Going going_ = Going::kNone;
  std::atomic<bool> ended_ = false;
  grpc::ClientContext* open_ = nullptr;
  std::thread thread_;
};

}  // namespace longreach
