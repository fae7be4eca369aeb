#include "common/site/rpc_security.hpp"

#include <asio/ip/address.hpp>

namespace longreach {

bool is_loopback(const std::string& address) {
  std::string host = address.substr(0, address.rfind(':'));
  if (host == "localhost") return true;
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  asio::error_code error;
  const auto parsed = asio::ip::make_address(host, error);
  return !error && parsed.is_loopback();
}

}  // namespace longreach
