#pragma once
// Protection of RPC connections: mutual TLS between the roles of one site, or none (on loopback only).

#include <optional>
#include <string>
#include <string_view>

namespace longreach {

enum class RpcRole { kSlave, kMaster, kClient };

/// Returns the DNS name that stands for a role in the certificate, so that the address of a side does not
/// matter.
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

/// Certificates and key as PEM text.
struct RpcCredentials {
  std::string authority;  // trusted authority
  std::string certificate;
  std::string key;
};

struct RpcSecurity {
  std::optional<RpcCredentials> credentials{};  // none: unencrypted, on loopback only
};

/// Returns whether address:port is reachable only from this machine.
bool is_loopback(const std::string& address);

}  // namespace longreach
