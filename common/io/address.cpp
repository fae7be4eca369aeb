#include "common/io/address.hpp"

#include <asio/io_context.hpp>
#include <charconv>
#include <optional>

namespace longreach {
namespace {

struct HostAndPort {
  std::string host;
  std::uint16_t port = 0;
};

std::optional<HostAndPort> split(const std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  HostAndPort out{text.substr(0, colon)};
  if (out.host.front() == '[' && out.host.back() == ']') {
    out.host = out.host.substr(1, out.host.size() - 2);
  } else if (out.host.find(':') != std::string::npos) {
    return std::nullopt;  // an IPv6 address needs its brackets
  }
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, out.port);
  const bool whole = error == std::errc{} && rest == end;
  return whole && !out.host.empty() ? std::optional(out) : std::nullopt;
}

}  // namespace

asio::ip::udp::endpoint parse_udp_address(const std::string& text) {
  const auto parts = split(text);
  if (!parts) {
    throw AddressError(
        "'" + text +
        "' is not an address; write address:port, e.g. 127.0.0.1:47001 or [::1]:47001, with a port from 0 "
        "to 65535");
  }
  asio::error_code error;
  const auto address = asio::ip::make_address(parts->host, error);
  if (!error) return {address, parts->port};
  asio::io_context context;
  asio::ip::udp::resolver resolver(context);
  const auto found = resolver.resolve(parts->host, std::to_string(parts->port), error);
  if (error || found.empty()) {
    throw AddressError("the host '" + parts->host + "' of '" + text +
                       "' cannot be found; check its name or write its address in numbers");
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
