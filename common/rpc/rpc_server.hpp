#pragma once
// Serves proto/control.proto for one side over gRPC, to many clients with one backend call at a time. Uses
// its own threads. A client needs a certificate of the same site (mutual TLS), and only the master role may
// open sessions. Without encryption, only the loopback interface is served. Connections pass through a
// ConnectionLimiter. The server raises the descriptor limit of the program.
//
// A refusal by the backend is reported as INVALID_ARGUMENT, FAILED_PRECONDITION or UNAVAILABLE. The trailing
// metadata kRefusedBy distinguishes it from an unreachable side.
//
// The calls to a slave are delayed by Impairment.rpc_delay_s (rpc_delay.hpp), except those that show and set the link.

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
inline constexpr std::string_view kAnsweredBy = "longreach-answered-by";  // of GetLink: the side
inline constexpr std::string_view kHeldBy = "longreach-held-by";          // value: Refusal::holder
inline constexpr int kWatchersMax = 64;     // further watchers are refused with RESOURCE_EXHAUSTED
inline constexpr double kWatchHzMin = 0.1;  // rates outside this range are clamped
inline constexpr double kWatchHzMax = 60.0;
inline constexpr double kWatchHzDefault = 4.0;

class RpcServer {
 public:
  /// Starts the server. `listen` is address:port; port 0 stands for any free port, and an empty string for the
  /// default address of the side. `side` is "master" or "slave". `more` lists further services besides
  /// Control. These services and `backend` must outlive the server. Throws std::runtime_error with a
  /// one-sentence message if the server cannot listen, or if it would serve other machines without encryption.
  RpcServer(const std::string& listen, ControlBackend& backend, std::string_view side,
            const RpcSecurity& security = {}, const std::vector<grpc::Service*>& more = {});
  ~RpcServer();
  RpcServer(const RpcServer&) = delete;
  RpcServer& operator=(const RpcServer&) = delete;

  /// Ends all calls, including those of watchers. Returns within 1 s, or when the current backend call
  /// returns.
  void stop();

  /// Returns the address and port of the server.
  [[nodiscard]] const std::string& address() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
