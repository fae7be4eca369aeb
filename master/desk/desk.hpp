#pragma once
// Serves pictures of the master to remote clients, and accepts a hand from them (service Desk in
// proto/control.proto). It runs in RPC threads: it reads data that the loop publishes and writes data that
// the loop may fetch, so that a slow or silent client never delays the loop.

#include <chrono>
#include <functional>
#include <mutex>

#include "master/console/snapshot.hpp"
#include "master/input/remote_hand.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {

// Each uses a thread of the server; more are refused with RESOURCE_EXHAUSTED.
inline constexpr int kFollowersMax = 16;
inline constexpr int kHandsMax = 8;

class DeskService final : public proto::Desk::Service {
 public:
  /// Radii of the workspace about the home of the handles; aims are limited to it.
  struct Reach {
    double translation_m = 0.075;
    double rotation_rad = 0.8;
  };
  /// Both functions are called from RPC threads; `aim` from one at a time.
  DeskService(const Reach& reach, std::function<ConsoleSnapshot()> snapshot,
              std::function<void(const RemoteAim&)> aim);

  grpc::Status Follow(grpc::ServerContext* context, const proto::FollowRequest* request,
                      grpc::ServerWriter<proto::Frame>* writer) override;
  grpc::Status Hold(grpc::ServerContext* context, grpc::ServerReader<proto::HandAim>* reader,
                    proto::Outcome* answer) override;

 private:
  using Instant = std::chrono::steady_clock::time_point;

  /// Takes one of a number of places; false: all are taken.
  bool take(int& taken, int places);
  void leave(int& taken);
  grpc::Status follow_hand(grpc::ServerContext& context, grpc::ServerReader<proto::HandAim>& reader,
                           proto::Outcome& answer);
  /// Returns the number of a new hand; 0: another hand has the handle. If several wait, a silent one is
  /// closed, since it would keep its thread forever.
  std::uint64_t take_handle(grpc::ServerContext& context);
  void leave_handle(const grpc::ServerContext& context);
  /// Returns false if `hand` no longer has the handle.
  bool pass(std::uint64_t hand, const RemoteAim& aim);

  Reach reach_;
  std::function<ConsoleSnapshot()> snapshot_;
  std::function<void(const RemoteAim&)> aim_;
  std::mutex mutex_;
  int followers_ = 0;
  int hands_there_ = 0;                    // streams, including refused and closed ones
  grpc::ServerContext* holder_ = nullptr;  // stream of the hand that has or last had the handle
  std::uint64_t hands_ = 0;                // number of hands so far
  bool held_ = false;                      // by the last of them
  Instant said_{};                         // time of its last message
};

}  // namespace longreach
