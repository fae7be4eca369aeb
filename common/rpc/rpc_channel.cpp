#include "common/rpc/rpc_channel.hpp"

#include <grpcpp/grpcpp.h>

#include <stdexcept>

#include "common/rpc/rpc_refusals.hpp"
#include "common/rpc/unknown_call.hpp"

namespace longreach {

namespace {

// A configuration with the meshes of its scene, which may be 64 MiB.
constexpr int kAnswerMaxBytes = 256 << 20;

/// Patient, and straight to the address.
grpc::ChannelArguments patient() {
  grpc::ChannelArguments arguments;
  arguments.SetUserAgentPrefix(user_agent());
  arguments.SetMaxReceiveMessageSize(kAnswerMaxBytes);
  // The addresses are the user's own machines: a proxy for the web does not lead there.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  // The least time that connecting is given; the call's deadline is the limit.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 240'000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  // A connection that is kept stays open at firewalls and address translators while there is no call.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // Also how long sent bytes may stay unacknowledged: a segment that is lost twice, 5 s away.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 60'000);
  return arguments;
}

}  // namespace

std::shared_ptr<grpc::Channel> connect_in_clear(const std::string& address) {
  take_rpc_log();
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), patient());
}

std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address, RpcRole side,
                                           const RpcSecurity& security) {
  if (!security.credentials && !is_loopback(address))
    throw std::runtime_error(address + " is not on this machine: omit --insecure to connect to it");
  if (!security.credentials) return connect_in_clear(address);
  take_rpc_log();
  grpc::ChannelArguments arguments = patient();
  const RpcCredentials& own = *security.credentials;
  arguments.SetSslTargetNameOverride(std::string(name_of(side)));
  return grpc::CreateCustomChannel(address, grpc::SslCredentials({own.authority, own.key, own.certificate}),
                                   arguments);
}

bool other_role(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::UNAVAILABLE &&
         status.error_message().find("not in peer certificate") != std::string::npos;
}

// gRPC distinguishes these cases only in the text of its message.
ConnectFailure connect_failure(const grpc::Status& status) {
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE) return ConnectFailure::kOther;
  const std::string message = status.error_message();
  const auto says = [&message](const char* words) { return message.find(words) != std::string::npos; };
  if (message.starts_with("empty address list")) return ConnectFailure::kOwnCertificate;
  if (message.starts_with("DNS resolution failed")) return ConnectFailure::kUnknownHost;
  if (!message.starts_with("failed to connect")) return ConnectFailure::kOther;
  if (says("Connection refused")) return ConnectFailure::kRefused;
  if (says("o route to host") || says("is unreachable") || says("timed out") || says("Host is down"))
    return ConnectFailure::kUnreachable;
  if (says("wrong version number") || says("http request")) return ConnectFailure::kNotTls;
  if (says("andshake failed")) return says(" alert ") ? ConnectFailure::kClosed : ConnectFailure::kMistrusted;
  if (says("Socket closed")) return ConnectFailure::kClosed;
  return says("reset by peer") || says("Broken pipe") ? ConnectFailure::kLost : ConnectFailure::kOther;
}

}  // namespace longreach
