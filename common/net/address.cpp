#include "common/net/address.hpp"

#include <asio/io_context.hpp>

#include "common/config/host_and_port.hpp"

namespace longreach {

asio::ip::udp::endpoint parse_udp_address(const std::string& text) {
  const auto parts = host_and_port(text);
  if (!parts) throw AddressError("'" + text + "'" + kNoAddress);
  asio::error_code error;
  const auto address = asio::ip::make_address(parts->host, error);
  if (!error) return {address, parts->port};
  asio::io_context context;
  asio::ip::udp::resolver resolver(context);
  const auto found = resolver.resolve(parts->host, std::to_string(parts->port), error);
  if (error || found.empty()) {
    throw AddressError("the host '" + parts->host + "' in '" + text +
                       "' cannot be resolved; check the name or use a numeric address");
  }
  // A name with both kinds: IPv4, as the default listening addresses are.
  for (const auto& entry : found) {
    if (entry.endpoint().address().is_v4()) return entry.endpoint();
  }
  return found.begin()->endpoint();
}

std::string to_string(const asio::ip::udp::endpoint& endpoint) {
  const std::string host = endpoint.address().to_string();
  const std::string port = std::to_string(endpoint.port());
  return endpoint.address().is_v6() ? "[" + host + "]:" + port : host + ":" + port;
}

}  // namespace longreach
