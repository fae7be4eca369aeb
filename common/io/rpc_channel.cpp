#include "common/io/rpc_channel.hpp"

#include <grpc/support/log.h>
#include <grpcpp/grpcpp.h>

namespace longreach {

std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address) {
  // gRPC's own log lines would stand beside the one sentence of the error.
  gpr_set_log_function([](gpr_log_func_args*) {});
  grpc::ChannelArguments arguments;
  // The addresses are the user's own machines: a proxy for the web does not lead there.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  // The least time that connecting is given; the call's deadline is the limit.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 90'000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 30'000);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace longreach
