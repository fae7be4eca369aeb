#include "common/config/adapter_address.hpp"

#include <string_view>

namespace longreach {
namespace {

constexpr std::string_view kScheme = "unix:";
constexpr std::size_t kPathMax = 107;  // sockaddr_un

}  // namespace

std::string adapter_path(const std::string& address) { return address.substr(kScheme.size()); }

std::string adapter_address_trouble(const std::string& address) {
  if (!address.starts_with(std::string(kScheme) + "/"))
    return " is not where an adapter listens: write unix:/PATH, its socket on this machine (an adapter of "
           "something "
           "elsewhere runs here, too, and goes there itself)";
  if (adapter_path(address).size() > kPathMax)
    return " is longer than the path of a socket may be, " + std::to_string(kPathMax) +
           " bytes: choose a shorter one";
  return "";
}

}  // namespace longreach
