#pragma once
// gRPC connection of a client to a side: direct, without a proxy; with timeouts for a link of seconds, where
// connecting takes several round trips; with fast reconnection to a restarted side.

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>
#include <string_view>

#include "common/site/rpc_security.hpp"

namespace longreach {

/// `address`: address:port of the RPC server of `side`. Does not wait: the first call connects. Throws
/// std::runtime_error for an unencrypted connection to another machine.
std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address, RpcRole side,
                                           const RpcSecurity& security);

/// Unencrypted connection to any address: for pairing only, which has its own protection.
std::shared_ptr<grpc::Channel> connect_in_clear(const std::string& address);

/// Returns whether a call failed because the program there has another role of the same site.
bool other_role(const grpc::Status& status);
/// Returns whether a call failed because one side does not trust the certificate of the other; kMistrust has
/// the remedy.
bool distrusted(const grpc::Status& status);
inline constexpr std::string_view kMistrust =
    "does not trust this program's certificate, or has a certificate of another site; use the same site "
    "folder for both "
    "(--site), and --insecure with both or with neither";

}  // namespace longreach
