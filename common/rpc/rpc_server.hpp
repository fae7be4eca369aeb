#pragma once
// Serves proto/control.proto for one side over gRPC: many clients, one backend call at a time, without a
// thread of the caller. A client needs a certificate of the same site (mutual TLS); only the role master may
// open sessions. Without encryption it serves loopback only. Connections pass a ConnectionLimiter. It raises
// the descriptor limit of the program.
//
// A refusal of the backend becomes INVALID_ARGUMENT, FAILED_PRECONDITION or UNAVAILABLE, with the trailing
// metadata kRefusedBy, which distinguishes a refusal from an unreachable side.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/rpc/control_backend.hpp"
#include "common/site/rpc_security.hpp"

namespace grpc {
class Service;
}

namespace longreach {

inline constexpr std::string_view kMasterRpcAddress = "127.0.0.1:47010";
inline constexpr std::string_view kSlaveRpcAddress = "127.0.0.1:47020";
inline constexpr std::string_view kRefusedBy = "longreach-refused-by";
inline constexpr std::string_view kHeldBy = "longreach-held-by";  // Refusal::holder
inline constexpr int kWatchersMax = 64;                           // more are refused with RESOURCE_EXHAUSTED
inline constexpr double kWatchHzMin = 0.1;                        // rates outside are clamped
inline constexpr double kWatchHzMax = 60.0;
inline constexpr double kWatchHzDefault = 4.0;

class RpcServer {
 public:
  /// Starts serving. `listen`: address:port; port 0: any free one; empty: the default address of the side.
  /// `side`: "master" or "slave". `more`: services besides Control. They and `backend` must outlive the
  /// server. Throws std::runtime_error, one sentence, if it cannot listen, or if it would serve other
  /// machines without encryption.
  RpcServer(const std::string& listen, ControlBackend& backend, std::string_view side,
            const RpcSecurity& security = {}, const std::vector<grpc::Service*>& more = {});
  ~RpcServer();
  RpcServer(const RpcServer&) = delete;
  RpcServer& operator=(const RpcServer&) = delete;

  /// Ends all calls, including watchers, and returns within 1 s, or when the present backend call returns.
  void stop();

  /// Address and port of the server.
  [[nodiscard]] const std::string& address() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
