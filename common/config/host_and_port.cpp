#include "common/config/host_and_port.hpp"

#include <string_view>

#include "common/text/number_text.hpp"

namespace longreach {

std::optional<HostAndPort> host_and_port(const std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find_first_of(":[]") != std::string::npos) {
    return std::nullopt;  // an IPv6 address needs its brackets
  }
  const auto port = parse_integer<std::uint16_t>(std::string_view(text).substr(colon + 1));
  if (!port || host.empty()) return std::nullopt;
  return HostAndPort{host, *port};
}

}  // namespace longreach
