#pragma once
// How an RPC connection is secured: by mutual TLS between roles of one site, or, on loopback alone, not at
// all.

#include <optional>
#include <string>
#include <string_view>

namespace longreach {

enum class RpcRole { kSlave, kMaster, kClient };

/// In certificates the role is a DNS name, so that it does not matter at which address a side is.
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
  std::string authority;  // whom to trust
  std::string certificate;
  std::string key;
};

struct RpcSecurity {
  std::optional<RpcCredentials> credentials{};  // none: in clear, to and from loopback only
};

/// Whether address:port means this machine itself, and only that.
bool is_loopback(const std::string& address);

}  // namespace longreach
