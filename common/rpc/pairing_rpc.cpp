#include "common/rpc/pairing_rpc.hpp"

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <mutex>

#include "common/loop/real_time_loop.hpp"
#include "common/rpc/rpc_channel.hpp"
#include "common/rpc/rpc_connection.hpp"
#include "common/rpc/rpc_refusals.hpp"
#include "proto/pairing.grpc.pb.h"

namespace longreach {
namespace {

constexpr int kPairingMaxBytes = 1 << 14;
constexpr int kPairingThreadsMax = 8;
constexpr auto kPairingGrace = std::chrono::seconds(2);

class Service final : public proto::Pairing::Service {
 public:
  Service(PairingOffer& offer, PairingServer::Tried tried) : offer_(offer), tried_(std::move(tried)) {}

  grpc::Status Join(grpc::ServerContext* context, const proto::PairingMessage* request,
                    proto::PairingMessage* answer) override {
    const std::lock_guard lock(mutex_);
    auto result = offer_.answer(*request, boottime_now());
    const auto* refusal = std::get_if<std::string>(&result);
    tried_(readable_peer(context->peer()), refusal != nullptr ? *refusal : "");
    if (refusal != nullptr) return {grpc::StatusCode::PERMISSION_DENIED, *refusal};
    *answer = std::get<proto::PairingMessage>(std::move(result));
    return grpc::Status::OK;
  }
  PairingOffer::State state() {
    const std::lock_guard lock(mutex_);
    return offer_.state(boottime_now());
  }

 private:
  PairingOffer& offer_;
  const PairingServer::Tried tried_;
  std::mutex mutex_;
};

}  // namespace

struct PairingServer::State {
  Service service;
  std::unique_ptr<grpc::Server> server;
};

PairingServer::PairingServer(const std::string& listen, PairingOffer& offer, Tried tried)
    : state_(new State{{offer, std::move(tried)}, {}}) {
  take_rpc_log();
  grpc::ServerBuilder builder;
  builder.SetMaxReceiveMessageSize(kPairingMaxBytes);
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.SetSyncServerOption(grpc::ServerBuilder::SyncServerOption::NUM_CQS, 1);
  builder.SetResourceQuota(grpc::ResourceQuota("longreach-pairing").SetMaxThreads(kPairingThreadsMax));
  int port = 0;
  builder.AddListeningPort(listen, grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&state_->service);
  state_->server = builder.BuildAndStart();
  if (!state_->server || port == 0)
    throw std::runtime_error("cannot listen for the joining host on " + listen +
                             ": stop the program that is using this port, or choose another one with "
                             "--pair-listen");
  address_ = listen.substr(0, listen.rfind(':') + 1) + std::to_string(port);
}

PairingServer::~PairingServer() {
  state_->server->Shutdown(std::chrono::system_clock::now() + kPairingGrace);
  state_->server->Wait();
}

PairingOffer::State PairingServer::state() const { return state_->service.state(); }

proto::PairingMessage ask_to_join(const std::string& address, const PairingRequest& request,
                                  std::optional<double> timeout_s) {
  RpcConnection connection(address);
  const auto stub = proto::Pairing::NewStub(connection.channel());
  const auto progress = connection.connect(timeout_s, std::atomic<bool>(false));
  grpc::ClientContext context;
  context.set_deadline(progress.call_until);
  proto::PairingMessage answer;
  const grpc::Status status = stub->Join(&context, request.message(), &answer);
  if (status.ok()) return answer;
  if (status.error_code() == grpc::StatusCode::PERMISSION_DENIED)
    throw PairingError("the slave at " + address + " refused: " + status.error_message());
  const ConnectFailure why = connect_failure(status);
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED || why == ConnectFailure::kRefused ||
      why == ConnectFailure::kUnreachable)
    throw PairingError(
        "no slave is ready for pairing at " + address + ": " +
        connect_trouble(status, progress,
                        "start longreach-slave --pair there; its token can be used once, within "
                        "10 minutes"));
  throw PairingError("the program at " + address +
                     " is not a longreach slave that is ready for pairing: use the address and port that "
                     "longreach-slave --pair printed");
}

}  // namespace longreach
