#pragma once
// gRPC connection from a client to a side. It does not use a proxy, its timeouts allow for delays of seconds
// (connecting takes several round trips), and it reconnects quickly to a side that restarted.

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>
#include <string_view>

#include "common/site/rpc_security.hpp"

namespace longreach {

/// `address` is the address:port of the RPC server of `side`. Returns immediately; the first call connects.
/// Throws std::runtime_error for an unencrypted connection to another machine.
std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address, RpcRole side,
                                           const RpcSecurity& security);

/// Returns an unencrypted connection to any address. Use it only for pairing, which has its own protection.
std::shared_ptr<grpc::Channel> connect_in_clear(const std::string& address);

/// Returns whether a call failed because the program at the address has a different role in the same site.
bool other_role(const grpc::Status& status);
/// Returns whether a call failed because one side does not trust the certificate of the other. kMistrust
/// describes the remedy.
bool distrusted(const grpc::Status& status);
inline constexpr std::string_view kMistrust =
    "does not trust this program's certificate, or has a certificate from another site, or the connection broke "
    "during the handshake; try again, use the same site folder for both (--site), and give --insecure to both or "
    "to neither";

}  // namespace longreach
