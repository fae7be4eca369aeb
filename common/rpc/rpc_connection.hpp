#pragma once
// The connection of a client to a side, which all calls share. The first call takes four round trips: TCP, TLS
// 1.3 with both certificates, HTTP/2 settings, and the call itself; each further call takes one.
//
// The time that a call may take follows the link, up to a round trip of 10 s, if the user gives no timeout:
// 15 s for the answer of the host to a TCP handshake, 60 s until the connection is complete, and then 3 s plus
// twice the time that connecting took. gRPC does not report how far an unfinished connection has come. A TCP
// handshake of its own (TcpProbe), which begins after 0.5 s, provides that.
//
//   local network     connected after 5 ms: a call may take 3.0 s
//   1.3 s each way    connected after 7.8 s: a call takes 2.6 s and may take 18.6 s
//   firewall          no answer to the TCP handshake: failure after 15.5 s

#include <grpcpp/channel.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/site/rpc_security.hpp"

namespace grpc {
class ClientContext;
}

namespace longreach {

class RpcConnection {
 public:
  using Clock = std::chrono::system_clock;  // gRPC's deadlines are of this clock

  /// As connect_rpc (rpc_channel.hpp).
  RpcConnection(std::string address, RpcRole side, const RpcSecurity& security);
  /// Without encryption, for pairing.
  explicit RpcConnection(std::string address);

  /// How far connecting has come.
  struct Progress {
    bool connected = false;
    bool failed = false;             // refused or broken; the next call returns the reason
    bool host_silent = false;        // the host does not answer a TCP handshake
    double waited_s = 0.0;           // time spent here
    std::optional<double> tcp_s{};   // duration of a TCP handshake; none: not measured
    double response_s = 0.0;         // time for the response to the call that follows
    Clock::time_point call_until{};  // its deadline

    /// Allows more time for the response.
    void allow(double more_s);
  };
  /// Connects, unless that has been done. Returns when the connection is complete, has failed, or `timeout_s`,
  /// which includes the call, has passed, or `cancelled` is set. After a failure (`failed`), gRPC repeats the
  /// attempt, but reports no further failure; this then waits about twice as long as before.
  Progress connect(std::optional<double> timeout_s, const std::atomic<bool>& cancelled,
                   const Progress* failed = nullptr);

  /// A call in progress, from its construction to its destruction.
  class Call {
   public:
    Call(RpcConnection& connection, grpc::ClientContext& context);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    RpcConnection& connection_;
    grpc::ClientContext& context_;
  };
  /// Ends every Call, now and later, and connect(). May be called from any thread.
  void cancel();

  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  [[nodiscard]] const std::string& address() const { return address_; }
  /// Time that connecting took, s.
  [[nodiscard]] double connect_s() const { return connect_s_; }

 private:
  const std::string address_;
  const std::shared_ptr<grpc::Channel> channel_;
  std::atomic<double> connect_s_{0.0};
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::vector<grpc::ClientContext*> calls_;
};

/// Returns the cause of a call that failed with `status`, as a clause about the program at the other end:
/// "no program is listening there; start ...". `progress` is that of its connection. `start` is the remedy if
/// nothing responds, e.g. "start longreach-slave there".
std::string connect_trouble(const grpc::Status& status, const RpcConnection::Progress& progress,
                            const std::string& start);

}  // namespace longreach
