#pragma once
// RPC client for one side. Every call, including connecting, returns within the timeout.

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/rpc/rpc_connection.hpp"
#include "deploy/cli/invocation.hpp"
#include "proto/config.pb.h"
#include "proto/control.pb.h"

namespace grpc {
class ClientContext;
class Status;
}  // namespace grpc

namespace longreach {

/// Thrown when a call fails. The message is one sentence that names the side.
class SideError : public std::runtime_error {
 public:
  enum class Kind {
    kDown,      // no reply: the request may or may not have been executed
    kAbsent,    // nothing accepts connections at the address, so the request was not executed
    kBroken,    // the connection broke while it was established, so the request was not executed
    kRefused,   // not possible in this state or on this side; nothing has changed
    kBadValue,  // invalid value; nothing has changed
  };
  SideError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// The connections of a process to both sides.
class RpcConnections {
 public:
  /// Returns the connection to a side, which need not be complete.
  std::shared_ptr<RpcConnection> to(Side side, const Options& options);
  /// Ends all calls, now and later.
  void cancel();

 private:
  std::mutex mutex_;
  std::array<std::shared_ptr<RpcConnection>, 2> open_{};
};

/// `connection_to` and `failure` are for calls that SideClient does not provide.
std::shared_ptr<RpcConnection> connection_to(Side side, const Options& options);
SideError failure(Side side, const Options& options, const grpc::ClientContext& context,
                  const grpc::Status& status, const RpcConnection::Progress& progress);

/// The status of a side, or the reason why there is none.
struct SideReport {
  Side side = Side::kMaster;
  std::string address;
  std::optional<proto::Status> status{};
  double age_s = 0.0;    // age of the status: how long it was on its way, and the time since it arrived
  std::string error{};   // the reason as one sentence; empty if there is a status
  bool awaited = false;  // no status yet, but the first one may still be on its way
};

class SideClient {
 public:
  SideClient(Side side, const Options& options);
  SideClient(SideClient&&) noexcept;
  ~SideClient();

  /// Ends the present call and all later ones with kDown. May be called from any thread.
  void cancel();

  // All functions throw SideError. Functions that return a string return the reply of the side.
  SideReport report();     // the status; does not throw
  proto::Status status();  // also throws if the other side responds at this address
  /// With `origin`, a comment behind each value names where it comes from.
  std::string get(const std::string& path, bool origin = false);
  /// A group of the configuration.
  template <class Message>
  Message part(const std::string& path) {
    Message message;
    take_part(path, message);
    return message;
  }
  std::string run(const proto::Action& action);
  std::string set(const std::vector<std::pair<std::string, std::string>>& assignments);
  proto::Impairment link();
  std::string set_link(const proto::Impairment& impairment, bool replace);
  std::string stop();

 private:
  void take_part(const std::string& path, google::protobuf::Message& message);

  struct State;
  std::unique_ptr<State> state_;
};

/// The newest status of a side. A dedicated thread reads it and reconnects when the side is available again.
class StatusStream {
 public:
  StatusStream(Side side, const Options& options, double rate_hz);
  ~StatusStream();
  StatusStream(const StatusStream&) = delete;
  StatusStream& operator=(const StatusStream&) = delete;

  [[nodiscard]] SideReport newest() const;
  /// Returns whether the first status, or the reason why there is none, has arrived.
  [[nodiscard]] bool settled() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
