#pragma once
// A client that holds the handle, like the page: it sends a target 50 times a second until it releases the handle or its
// connection breaks.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "common/rpc/rpc_channel.hpp"
#include "proto/control.grpc.pb.h"
#include "tests/support/test_site.hpp"

namespace longreach {

class HandClient {
 public:
  /// `port`: port of the master's RPC server on this host.
  explicit HandClient(int port)
      : stub_(proto::Desk::NewStub(
            connect_rpc("127.0.0.1:" + std::to_string(port), RpcRole::kMaster, test_site(RpcRole::kClient)))),
        stream_(stub_->Hold(&context_, &outcome_)),
        thread_([this] { send(); }) {}
  ~HandClient() {
    if (thread_.joinable()) lose();
  }
  HandClient(const HandClient&) = delete;
  HandClient& operator=(const HandClient&) = delete;

  /// Sets the target along x, relative to the handle when this client took control.
  void aim(double x_m) { x_m_ = x_m; }
  void release() {
    end_ = true;
    thread_.join();
    proto::HandAim last;
    last.set_lets_go(true);
    stream_->Write(last);
    EXPECT_TRUE(stream_->Finish().ok());
  }
  /// Breaks the connection without a release.
  void lose() {
    end_ = true;
    thread_.join();
    context_.TryCancel();
    (void)stream_->Finish();
  }
  /// Waits until the master ends the connection, and returns why.
  std::string refusal() {
    thread_.join();
    return stream_->Finish().error_message();
  }

 private:
  void send() {
    while (!end_) {
      proto::HandAim aim;
      for (const double v : {x_m_.load(), 0.0, 0.0}) aim.add_position_m(v);
      if (!stream_->Write(aim)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  std::unique_ptr<proto::Desk::Stub> stub_;
  grpc::ClientContext context_;
  proto::Outcome outcome_;
  std::unique_ptr<grpc::ClientWriter<proto::HandAim>> stream_;
  std::atomic<double> x_m_ = 0.0;
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

}  // namespace longreach
