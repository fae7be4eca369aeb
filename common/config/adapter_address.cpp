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
    return " is not an adapter address: write unix:/PATH, where PATH is the adapter's socket on this "
           "machine (the adapter of a remote device also runs on this machine and connects to the device)";
  if (adapter_path(address).size() > kPathMax)
    return " is too long for a socket path: the maximum is " + std::to_string(kPathMax) +
           " bytes; choose a shorter path";
  return "";
}

}  // namespace longreach
