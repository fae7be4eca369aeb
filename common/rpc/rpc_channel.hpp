#pragma once
// A gRPC connection to a side, as every client of ours makes it: straight, no proxy; patient enough for a
// link of seconds, where connecting takes several round trips; quick to find a side that has come back.

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>
#include <string_view>

#include "common/site/rpc_security.hpp"

namespace longreach {

/// `address`: address:port of the RPC server of `side`. Does not wait: the first call connects. Throws
/// std::runtime_error for a connection in clear that would leave this machine.
std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address, RpcRole side,
                                           const RpcSecurity& security);

/// To wherever, in clear: for pairing alone, which protects itself.
std::shared_ptr<grpc::Channel> connect_in_clear(const std::string& address);

/// Whether a call failed because what answers has another role of the same site.
bool other_role(const grpc::Status& status);
/// Whether a call failed because one of the two does not trust the other's certificate; kMistrust says what
/// to do.
bool distrusted(const grpc::Status& status);
inline constexpr std::string_view kMistrust =
    "does not trust this program's certificate, or has a certificate of another site; use the same site "
    "folder for both "
    "(--site), and --insecure with both or with neither";

}  // namespace longreach
