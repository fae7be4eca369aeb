#include "deploy/cli/view/view_hand.hpp"

#include <grpcpp/grpcpp.h>

#include "deploy/cli/side_client.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {

ViewHand::ViewHand(const Options& options, std::function<void(const std::string&)> refused)
    : options_(options), refused_(std::move(refused)) {
  thread_ = std::thread([this] { run(); });
}

ViewHand::~ViewHand() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (open_ != nullptr) open_->TryCancel();
    changed_.notify_all();
  }
  thread_.join();
}

void ViewHand::aim(const proto::HandAim& aim) {
  const std::lock_guard lock(mutex_);
  newest_ = aim;
  going_ = Going::kNone;
  changed_.notify_all();
}

void ViewHand::let_go(bool lost) {
  const std::lock_guard lock(mutex_);
  newest_.reset();
  going_ = lost ? Going::kLost : Going::kOrderly;
  changed_.notify_all();
}

/// Waits for the next aim to forward. Returns std::nullopt if the hand leaves.
std::optional<proto::HandAim> ViewHand::next(Going& going) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || newest_ || going_ != Going::kNone; });
  going = ended_ ? Going::kLost : going_;
  std::optional<proto::HandAim> aim;
  if (!ended_) aim.swap(newest_);
  if (!aim) going_ = Going::kNone;
  return aim;
}

void ViewHand::run() {
  while (true) {
    {
      // A release without a preceding aim is ignored.
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ended_ || newest_; });
      if (ended_) return;
    }
    try {
      hold();
    } catch (const std::exception& error) {
      refused_(error.what());
    }
  }
}

/// Runs one stream, from the first aim until the hand leaves.
void ViewHand::hold() {
  const auto connection = connection_to(Side::kMaster, options_);
  const auto stub = proto::Desk::NewStub(connection->channel());
  const auto progress = connection->connect(options_.timeout_s, ended_);
  grpc::ClientContext context;
  if (!progress.connected) context.set_deadline(progress.call_until);
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    open_ = &context;
  }
  proto::Outcome outcome;
  const auto stream = stub->Hold(&context, &outcome);
  Going going = Going::kNone;
  bool written = true;
  const auto options = grpc::WriteOptions().set_no_compression().set_write_through();
  while (written) {
    const auto aim = next(going);
    if (!aim) break;
    written = stream->Write(*aim, options);
  }
  if (written && going == Going::kLost) context.TryCancel();
  if (written && going == Going::kOrderly) {
    proto::HandAim last;
    last.set_lets_go(true);
    stream->WriteLast(last, options);
  }
  const grpc::Status end = stream->Finish();
  const std::lock_guard lock(mutex_);
  open_ = nullptr;
  newest_.reset();
  if (!written) refused_(failure(Side::kMaster, options_, context, end, progress).what());
}

}  // namespace longreach
