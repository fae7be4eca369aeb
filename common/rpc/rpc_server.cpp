#include "common/rpc/rpc_server.hpp"

#include <grpcpp/grpcpp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/config/host_and_port.hpp"
#include "common/rpc/caller_certificate.hpp"
#include "common/rpc/connection_limiter.hpp"
#include "common/rpc/control_rpc.hpp"
#include "common/rpc/rpc_refusals.hpp"
#include "common/rpc/unknown_call.hpp"

namespace longreach {
namespace {

constexpr int kRequestMaxBytes = 1 << 20;
constexpr int kThreadsMax = kWatchersMax + 32;
constexpr auto kRevocationCheck = std::chrono::milliseconds(100);
constexpr auto kFinishGrace = std::chrono::milliseconds(200);  // for calls that are under way at the stop

std::string listen_address(const std::string& listen, std::string_view side) {
  if (listen.empty()) return std::string(side == "slave" ? kSlaveRpcAddress : kMasterRpcAddress);
  if (!host_and_port(listen))
    throw std::runtime_error("the " + std::string(side) + " cannot listen for RPC clients on '" + listen +
                             "': set rpc.listen to address:port, e.g. 127.0.0.1:47010");
  return listen;
}

void configure(grpc::ServerBuilder& builder) {
  builder.SetMaxReceiveMessageSize(kRequestMaxBytes);
  // Generous: a client may itself be many seconds away.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 60'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 10'000);
  builder.SetSyncServerOption(grpc::ServerBuilder::SyncServerOption::NUM_CQS, 1);
  builder.SetResourceQuota(grpc::ResourceQuota("longreach-control").SetMaxThreads(kThreadsMax));
}

/// Of which 1024 are usual.
void raise_descriptor_limit() {
  constexpr rlim_t kDescriptors = 65'536;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= kDescriptors) return;
  limit.rlim_cur = std::min(limit.rlim_max, kDescriptors);
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

std::shared_ptr<grpc::ServerCredentials> server_credentials(const RpcSecurity& security) {
  if (!security.credentials) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions options(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_root_certs = security.credentials->authority;
  options.pem_key_cert_pairs = {{security.credentials->key, security.credentials->certificate}};
  auto credentials = grpc::SslServerCredentials(options);
  credentials->SetAuthMetadataProcessor(revocation_check());
  return credentials;
}

}  // namespace

struct RpcServer::State {
  State(ControlBackend& backend, std::string_view side, bool secured)
      : control(backend, side, secured), unknown(side) {}
  ControlRpc control;
  UnknownCalls unknown;
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> acceptor;
  std::unique_ptr<ListeningSocket> socket;
  std::unique_ptr<ConnectionLimiter> access;
  std::string address;
  std::jthread revocations;  // looks whether the holder of the session is revoked

  void let_in(int fd) {
    grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters connection;
    connection.listener_fd = socket->fd();
    connection.fd = fd;
    acceptor->HandleNewConnection(&connection);
  }
};

RpcServer::RpcServer(const std::string& listen, ControlBackend& backend, std::string_view side,
                     const RpcSecurity& security, const std::vector<grpc::Service*>& more)
    : state_(std::make_unique<State>(backend, side, security.credentials.has_value())) {
  const std::string address = listen_address(listen, side);
  if (!security.credentials && !is_loopback(address))
    throw std::runtime_error("the " + std::string(side) + " does not serve RPC on " + address +
                             " without encryption: omit --insecure, or set rpc.listen to a loopback address");
  raise_descriptor_limit();
  take_rpc_log();
  state_->socket = std::make_unique<ListeningSocket>(address);
  grpc::ServerBuilder builder;
  configure(builder);
  state_->acceptor = builder.experimental().AddExternalConnectionAcceptor(
      grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, server_credentials(security));
  builder.RegisterService(&state_->control);
  builder.RegisterCallbackGenericService(&state_->unknown);
  for (grpc::Service* service : more) builder.RegisterService(service);
  if (state_->socket->fd() >= 0) state_->server = builder.BuildAndStart();
  if (!state_->server)
    throw std::runtime_error(
        "the " + std::string(side) + " cannot listen for RPC clients on " + address +
        ": stop the program that is using this port, or set rpc.listen to a free port on an address "
        "of this machine");
  state_->address = address.substr(0, address.rfind(':') + 1) + std::to_string(state_->socket->port());
  state_->access =
      std::make_unique<ConnectionLimiter>(*state_->socket, [this](int fd) { state_->let_in(fd); });
  state_->revocations = std::jthread([control = &state_->control](const std::stop_token& ends) {
    for (; !ends.stop_requested(); std::this_thread::sleep_for(kRevocationCheck)) control->end_revoked();
  });
}

RpcServer::~RpcServer() { stop(); }

void RpcServer::stop() {
  if (!state_->server) return;
  state_->access.reset();
  state_->revocations = {};  // it ends within kRevocationCheck
  state_->control.begin_stop();
  state_->server->Shutdown(std::chrono::system_clock::now() + kFinishGrace);
  state_->server->Wait();
  state_->server.reset();
  state_->socket.reset();  // its port is free
}

const std::string& RpcServer::address() const { return state_->address; }

}  // namespace longreach
