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
/// Why a connection could not be established.
enum class ConnectFailure {
  kOther,           // none of the following, or the call failed on a complete connection
  kRefused,         // nothing listens at the port
  kUnreachable,     // the network has no route, or the host does not answer
  kUnknownHost,     // the name of the host cannot be resolved
  kNotTls,          // the program there does not use TLS
  kMistrusted,      // the certificate of the program there is not valid for this site
  kOwnCertificate,  // the certificate or key of this program is unusable
  kClosed,          // the other end closed the connection during the handshake
  kLost,            // the connection was reset during the handshake
};
ConnectFailure connect_failure(const grpc::Status& status);

}  // namespace longreach
