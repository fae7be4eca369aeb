#pragma once
// Serves pictures of the master to eyes elsewhere, and takes a hand from there (service Desk in
// proto/control.proto). Lives in RPC threads: it reads what the loop publishes and writes what the loop may
// fetch, so that nobody here, however slow or silent, makes the loop wait.

#include <chrono>
#include <functional>
#include <mutex>

#include "master/console/snapshot.hpp"
#include "master/input/remote_hand.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {

// Each takes a thread of the server; more are refused with RESOURCE_EXHAUSTED.
inline constexpr int kFollowersMax = 16;
inline constexpr int kHandsMax = 8;

class DeskService final : public proto::Desk::Service {
 public:
  /// Radii of the workspace about the handles' home: aims are kept within.
  struct Reach {
    double translation_m = 0.075;
    double rotation_rad = 0.8;
  };
  /// Both functions are called from RPC threads; `aim` by one at a time.
  DeskService(const Reach& reach, std::function<ConsoleSnapshot()> snapshot,
              std::function<void(const RemoteAim&)> aim);

  grpc::Status Follow(grpc::ServerContext* context, const proto::FollowRequest* request,
                      grpc::ServerWriter<proto::Frame>* writer) override;
  grpc::Status Hold(grpc::ServerContext* context, grpc::ServerReader<proto::HandAim>* reader,
                    proto::Outcome* answer) override;

 private:
  using Instant = std::chrono::steady_clock::time_point;

  /// One of so many places; false: all are taken.
  bool take(int& taken, int places);
  void leave(int& taken);
  grpc::Status follow_hand(grpc::ServerContext& context, grpc::ServerReader<proto::HandAim>& reader,
                           proto::Outcome& answer);
  /// The number of a new hand; 0: another one is there. A silent one is sent away where there are several: it
  /// would keep its thread for ever.
  std::uint64_t take_handle(grpc::ServerContext& context);
  void leave_handle(const grpc::ServerContext& context);
  /// False when `hand` is not the one on the handle any more.
  bool pass(std::uint64_t hand, const RemoteAim& aim);

  Reach reach_;
  std::function<ConsoleSnapshot()> snapshot_;
  std::function<void(const RemoteAim&)> aim_;
  std::mutex mutex_;
  int followers_ = 0;
  int hands_there_ = 0;                    // streams, also of those who are refused or sent away
  grpc::ServerContext* holder_ = nullptr;  // stream of the hand that is or was last on the handle
  std::uint64_t hands_ = 0;                // so far
  bool held_ = false;                      // by the last of them
  Instant said_{};                         // its last message
};

}  // namespace longreach
