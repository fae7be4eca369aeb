#include "common/rpc/rpc_delay.hpp"

#include <algorithm>

#include "common/text/number_text.hpp"

namespace longreach {
namespace {

RpcDelay::Duration duration_of(double seconds) {
  return std::chrono::duration_cast<RpcDelay::Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

RpcDelay::Times RpcDelay::of(const std::string& client, double round_trip_s) {
  constexpr double kConnecting = 3.0;  // round trips: TCP, TLS, HTTP/2 settings
  const std::lock_guard lock(mutex_);
  const bool first = std::ranges::find(connected_, client) == connected_.end();
  return {duration_of((first ? kConnecting + 0.5 : 0.5) * round_trip_s), duration_of(0.5 * round_trip_s)};
}

void RpcDelay::accept(const std::string& client) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(connected_, client) != connected_.end()) return;
  connected_.push_back(client);
  if (connected_.size() > kConnectionsMax) connected_.pop_front();
}

std::optional<double> artificial_delay_s(const std::multimap<grpc::string_ref, grpc::string_ref>& metadata) {
  const auto found = metadata.find(grpc::string_ref(kRpcDelay.data(), kRpcDelay.size()));
  if (found == metadata.end()) return {};
  return parse_number(std::string_view(found->second.data(), found->second.size()));
}

}  // namespace longreach
