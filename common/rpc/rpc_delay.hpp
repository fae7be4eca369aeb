#pragma once
// The artificial delay of calls to a server: that of a link with the round trip Impairment.rpc_delay_s. The first
// call of a connection takes four round trips, because connecting would have taken three of them, and each
// further call takes one. A request is executed half a round trip before its response arrives.
//
//   2.6 s  first call: executed after 9.1 s, response after 10.4 s; further calls: after 1.3 s and 2.6 s
//
// Connections themselves are not delayed, so that calls that change the delay can be exempt. A client therefore cannot
// derive its timeout from the time that connecting took. A call whose deadline is too early is refused at once, with the
// delay in the trailing metadata kRpcDelay, and the client repeats it with so much more time (artificial_delay_s).

#include <grpcpp/support/string_ref.h>

#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace longreach {

inline constexpr std::string_view kRpcDelay = "longreach-rpc-delay-s";

class RpcDelay {
 public:
  using Duration = std::chrono::steady_clock::duration;
  struct Times {
    Duration request{};   // until the call is executed
    Duration response{};  // from then until the response is sent
    [[nodiscard]] double total_s() const { return std::chrono::duration<double>(request + response).count(); }
  };

  /// Returns the delay of a call on the connection of `client` (its address and port).
  Times of(const std::string& client, double round_trip_s);
  /// Call this when a call of `client` is accepted; those that follow it are further calls.
  void accept(const std::string& client);

 private:
  static constexpr std::size_t kConnectionsMax = 256;

  std::mutex mutex_;
  std::deque<std::string> connected_;  // clients, the oldest first
};

/// Returns the artificial delay of a call that the server reports in its metadata, s; none: it reports no delay.
std::optional<double> artificial_delay_s(const std::multimap<grpc::string_ref, grpc::string_ref>& metadata);

}  // namespace longreach
