#pragma once
// The hand of a page on its way to the master: a thread that passes on the newest aim, each once, over the
// RPC Hold. What the page does not say is not said: the master notices by itself that a hand has fallen
// silent.

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
  /// `refused`: the master does not take the hand, and why.
  ViewHand(const Options& options, std::function<void(const std::string&)> refused);
  ~ViewHand();
  ViewHand(const ViewHand&) = delete;
  ViewHand& operator=(const ViewHand&) = delete;

  // From any thread; they do not wait.
  void aim(const proto::HandAim& aim);
  /// `lost`: the stream is broken off, so that the robot holds.
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
  bool ended_ = false;
  grpc::ClientContext* open_ = nullptr;
  std::thread thread_;
};

}  // namespace longreach
