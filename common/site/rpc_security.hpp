#pragma once
// Protection of RPC connections: mutual TLS between roles of one site, or, on loopback only, none.

#include <optional>
#include <string>
#include <string_view>

namespace longreach {

enum class RpcRole { kSlave, kMaster, kClient };

/// The role is a DNS name in the certificate, so that the address of a side does not matter.
constexpr std::string_view name_of(RpcRole role) {
  switch (role) {
    case RpcRole::kSlave:
      return "slave.longreach";
    case RpcRole::kMaster:
      return "master.longreach";
    case RpcRole::kClient:
      return "client.longreach";
  }
  return "";
}

/// PEM texts.
struct RpcCredentials {
  std::string authority;  // authority to trust
  std::string certificate;
  std::string key;
};

struct RpcSecurity {
  std::optional<RpcCredentials> credentials{};  // none: unencrypted, on loopback only
};

/// Returns whether address:port is reachable from this machine only.
bool is_loopback(const std::string& address);

}  // namespace longreach
