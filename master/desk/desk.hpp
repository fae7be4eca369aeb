#pragma once
// Serves snapshots of the master to remote clients, and accepts hand input from them (service Desk in
// proto/control.proto). It runs in RPC threads: it reads data that the loop publishes and writes data that
// the loop may fetch, so that a slow or unresponsive client never delays the loop.

#include <chrono>
#include <functional>
#include <mutex>

#include "master/console/snapshot.hpp"
#include "master/input/remote_hand.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {

// Maximum numbers of streams. Each stream uses a thread of the server; further streams are refused with
// RESOURCE_EXHAUSTED.
inline constexpr int kFollowersMax = 16;
inline constexpr int kHandsMax = 8;

class DeskService final : public proto::Desk::Service {
 public:
  /// Radii of the workspace around the home of the handles. Targets are clamped to it.
  struct Reach {
    double translation_m = 0.075;
    double rotation_rad = 0.8;
  };
  /// `snapshot` and `aim` are called from RPC threads, `aim` only by one thread at a time. `aim` is empty if the handle
  /// is a real device, which clients cannot move.
  DeskService(const Reach& reach, std::function<ConsoleSnapshot()> snapshot,
              std::function<void(const RemoteAim&)> aim);

  grpc::Status Follow(grpc::ServerContext* context, const proto::FollowRequest* request,
                      grpc::ServerWriter<proto::Frame>* writer) override;
  grpc::Status Hold(grpc::ServerContext* context, grpc::ServerReader<proto::HandAim>* reader,
                    proto::Outcome* answer) override;

 private:
  using Instant = std::chrono::steady_clock::time_point;

  /// Reserves one of `places` slots. Returns false if all are in use.
  bool take(int& taken, int places);
  void leave(int& taken);
  grpc::Status follow_hand(grpc::ServerContext& context, grpc::ServerReader<proto::HandAim>& reader,
                           proto::Outcome& answer);
  /// Gives control of the handle to a new client. Returns the number of the client, or 0 if another client
  /// has control. A client that has stopped sending is replaced; its stream is closed if the number of open
  /// streams is near its maximum, because it would otherwise occupy a thread forever.
  std::uint64_t take_handle(grpc::ServerContext& context);
  void leave_handle(const grpc::ServerContext& context);
  /// Passes a target to the loop. Returns false if the client `hand` no longer controls the handle.
  bool pass(std::uint64_t hand, const RemoteAim& aim);

  Reach reach_;
  std::function<ConsoleSnapshot()> snapshot_;
  std::function<void(const RemoteAim&)> aim_;
  std::mutex mutex_;
  int followers_ = 0;
  int hands_there_ = 0;  // number of open streams, including those without control of the handle
  grpc::ServerContext* holder_ = nullptr;  // stream of the client that controls or last controlled the handle
  std::uint64_t hands_ = 0;                // number of clients so far; identifies the newest client
  bool held_ = false;                      // the newest client controls the handle
  Instant said_{};                         // time of the newest client's last message
};

}  // namespace longreach
