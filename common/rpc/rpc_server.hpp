#pragma once
// Serves proto/control.proto for one side over gRPC: many clients, one backend call at a time. Needs no
// thread of the caller. A client has to show a certificate of the same site (mutual TLS); sessions are opened
// for the role of the master alone. In clear it serves loopback only. Connections come through a
// ConnectionLimiter. It raises the program's limit of descriptors.
//
// A refusal of the backend becomes INVALID_ARGUMENT, FAILED_PRECONDITION or UNAVAILABLE, with the trailing
// metadata kRefusedBy, by which a client tells a side that refuses from a side that cannot be reached.

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
inline constexpr double kWatchHzMin = 0.1;                        // rates beyond are taken as the nearest
inline constexpr double kWatchHzMax = 60.0;
inline constexpr double kWatchHzDefault = 4.0;

class RpcServer {
 public:
  /// Serves at once. `listen`: address:port; port 0: any free one; empty: the side's default address. `side`:
  /// "master" or "slave". `more`: services beside Control. They and `backend` must outlive the server. Throws
  /// std::runtime_error, one sentence, when it cannot listen, or when it would serve others than this machine
  /// in clear.
  RpcServer(const std::string& listen, ControlBackend& backend, std::string_view side,
            const RpcSecurity& security = {}, const std::vector<grpc::Service*>& more = {});
  ~RpcServer();
  RpcServer(const RpcServer&) = delete;
  RpcServer& operator=(const RpcServer&) = delete;

  /// Ends all calls, watchers too, and returns within 1 s, or when the backend returns from the call that it
  /// is in.
  void stop();

  /// Address and port that it listens on.
  [[nodiscard]] const std::string& address() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
