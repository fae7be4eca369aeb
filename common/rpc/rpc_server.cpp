#include "common/rpc/rpc_server.hpp"

#include <grpcpp/grpcpp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <variant>

#include "common/config/host_and_port.hpp"
#include "common/loop/pace.hpp"
#include "common/program/log.hpp"
#include "common/rpc/caller_certificate.hpp"
#include "common/rpc/connection_limiter.hpp"
#include "common/rpc/control_service.hpp"
#include "common/rpc/rpc_refusals.hpp"
#include "common/rpc/status_fields.hpp"
#include "common/site/revocations.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRequestMaxBytes = 1 << 20;
constexpr int kThreadsMax = kWatchersMax + 32;
constexpr auto kRevocationCheck = std::chrono::milliseconds(100);
constexpr int kCloseTries = 50;
constexpr auto kLeaveCheck = std::chrono::milliseconds(100);   // how soon a watcher that left is noticed
constexpr auto kFinishGrace = std::chrono::milliseconds(200);  // for calls that are under way at the stop

grpc::StatusCode code_of(Refusal::Kind kind) {
  switch (kind) {
    case Refusal::Kind::kInvalid:
      return grpc::StatusCode::INVALID_ARGUMENT;
    case Refusal::Kind::kPrecondition:
      return grpc::StatusCode::FAILED_PRECONDITION;
    case Refusal::Kind::kUnavailable:
      return grpc::StatusCode::UNAVAILABLE;
  }
  return grpc::StatusCode::INTERNAL;
}

/// Cuts a text at a whole UTF-8 character: status messages travel percent-encoded in 8 KiB of metadata.
std::string cut(std::string text) {
  constexpr std::size_t kMessageMaxBytes = 2000;
  if (text.size() <= kMessageMaxBytes) return text;
  std::size_t end = kMessageMaxBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

double watch_rate_hz(const proto::WatchRequest& request) {
  if (!request.has_rate_hz()) return kWatchHzDefault;
  if (!(request.rate_hz() > kWatchHzMin)) return kWatchHzMin;  // also what is not a number
  return std::min(request.rate_hz(), kWatchHzMax);
}

/// ControlService over gRPC: one blocking call a thread, of which there may be none left; but stop, which
/// waits for nobody, and the status, which is asked most, are answered by the thread that hears the question.
class GrpcControl final : public proto::Control::WithCallbackMethod_Stop<
                              proto::Control::WithCallbackMethod_GetStatus<proto::Control::Service>> {
 public:
  using Context = grpc::ServerContext;
  using CallbackContext = grpc::CallbackServerContext;

  GrpcControl(ControlBackend& backend, std::string_view side, bool secured)
      : service_(backend), side_(side), secured_(secured) {}

  grpc::ServerUnaryReactor* GetStatus(CallbackContext* context, const proto::StatusRequest*,
                                      proto::Status* answer) override {
    *answer = status();
    return heard(context, grpc::Status::OK);
  }
  grpc::ServerUnaryReactor* Stop(CallbackContext* context, const proto::StopRequest*,
                                 proto::Outcome* answer) override {
    return heard(context, finish(context, service_.stop(), answer));
  }
  grpc::Status GetConfig(Context* context, const proto::GetConfigRequest* request,
                         proto::GetConfigResponse* answer) override {
    return finish(context, service_.get_config(*request), answer);
  }
  grpc::Status SetConfig(Context* context, const proto::SetConfigRequest* request,
                         proto::Outcome* answer) override {
    return finish(context, service_.set_config(*request), answer);
  }
  grpc::Status GetLink(Context*, const proto::GetLinkRequest*, proto::Impairment* answer) override {
    *answer = service_.get_link();
    return grpc::Status::OK;
  }
  grpc::Status SetLink(Context* context, const proto::SetLinkRequest* request,
                       proto::Outcome* answer) override {
    return finish(context, service_.set_link(*request), answer);
  }
  grpc::Status SetMode(Context* context, const proto::SetModeRequest* request,
                       proto::Outcome* answer) override {
    return finish(context, service_.set_mode(*request), answer);
  }
  grpc::Status SetScale(Context* context, const proto::SetScaleRequest* request,
                        proto::Outcome* answer) override {
    return finish(context, service_.set_scale(*request), answer);
  }
  grpc::Status Engage(Context* context, const proto::EngageRequest*, proto::Outcome* answer) override {
    return finish(context, service_.engage(), answer);
  }
  grpc::Status OpenSession(Context* context, const proto::OpenSessionRequest* request,
                           proto::OpenSessionResponse* answer) override {
    if (!is_master(*context)) return denied(*context, "only a master of this site may open a session");
    const grpc::Status status = finish(context, service_.open_session(*request, caller_of(*context)), answer);
    if (status.ok()) note_holder(answer->session(), fingerprint_of(*context->auth_context()));
    return status;
  }
  grpc::Status CloseSession(Context* context, const proto::CloseSessionRequest* request,
                            proto::Outcome* answer) override {
    if (!is_master(*context)) return denied(*context, "only a master of this site may close a session");
    return finish(context, service_.close_session(*request), answer);
  }
  grpc::Status StartRecording(Context* context, const proto::StartRecordingRequest* request,
                              proto::Outcome* answer) override {
    return finish(context, service_.start_recording(*request), answer);
  }
  grpc::Status StopRecording(Context* context, const proto::StopRecordingRequest*,
                             proto::Outcome* answer) override {
    return finish(context, service_.stop_recording(), answer);
  }

  grpc::Status Watch(Context* context, const proto::WatchRequest* request,
                     grpc::ServerWriter<proto::Status>* writer) override {
    const Slot slot(*this);
    if (!slot.taken())
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, std::to_string(kWatchersMax) +
                                                        " clients are already watching the " + side_ +
                                                        ": close one of them"};
    for (Pace pace(watch_rate_hz(*request)); wait_until(pace.due(), *context); pace.advance())
      if (is_revoked(*context->auth_context()) || !writer->Write(status())) break;
    return stopping() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the " + side_ + " is shutting down")
                      : grpc::Status::OK;
  }

  /// A revoked master gives back the robot, which holds then.
  void end_revoked() {
    std::uint64_t session = 0;
    {
      const std::lock_guard lock(mutex_);
      if (holder_.empty() || !is_revoked(holder_)) return;
      session = session_;
    }
    proto::CloseSessionRequest request;
    request.set_session(session);
    const bool closed = !std::holds_alternative<Refusal>(service_.close_session(request));
    // A loop that did not answer is asked again; one that says that it is another's session is not for ever.
    const std::lock_guard lock(mutex_);
    if (session != session_ || (!closed && ++close_tries_ < kCloseTries)) return;
    holder_.clear();
  }

  void begin_stop() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
  }

 private:
  /// A watcher's place among kWatchersMax.
  class Slot {
   public:
    explicit Slot(GrpcControl& control) : control_(control) {
      const std::lock_guard lock(control_.mutex_);
      taken_ = control_.watchers_ < kWatchersMax;
      if (taken_) ++control_.watchers_;
    }
    ~Slot() {
      const std::lock_guard lock(control_.mutex_);
      if (taken_) --control_.watchers_;
    }
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
    [[nodiscard]] bool taken() const { return taken_; }

   private:
    GrpcControl& control_;
    bool taken_ = false;
  };

  static grpc::ServerUnaryReactor* heard(CallbackContext* context, const grpc::Status& status) {
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(status);
    return reactor;
  }

  template <class Answer>
  grpc::Status finish(grpc::ServerContextBase* context, ControlService::Result<Answer> result,
                      Answer* answer) {
    if (const auto* refusal = std::get_if<Refusal>(&result)) {
      context->AddTrailingMetadata(std::string(kRefusedBy), side_);
      if (!refusal->holder.empty()) context->AddTrailingMetadata(std::string(kHeldBy), refusal->holder);
      return {code_of(refusal->kind), cut(refusal->message)};
    }
    *answer = std::get<Answer>(std::move(result));
    return grpc::Status::OK;
  }

  proto::Status status() {
    proto::Status out = service_.status();
    add_count(out, "rpc_refused", rpc_refusals());
    add_count(out, "log_lost", log_lost());
    return out;
  }

  bool is_master(const Context& context) const {
    if (!secured_) return true;
    const std::string_view wanted = name_of(RpcRole::kMaster);
    const auto names = context.auth_context()->FindPropertyValues(GRPC_X509_SAN_PROPERTY_NAME);
    return std::find(names.begin(), names.end(), grpc::string_ref(wanted.data(), wanted.size())) !=
           names.end();
  }
  static grpc::Status denied(const Context& context, const char* why) {
    note_rpc_refusal(caller_of(context) + " " + certificate_text(*context.auth_context()), why);
    return {grpc::StatusCode::PERMISSION_DENIED, why};
  }

  static std::string caller_of(const Context& context) { return readable_peer(context.peer()); }

  void note_holder(std::uint64_t session, const std::string& fingerprint) {
    const std::lock_guard lock(mutex_);
    session_ = session;
    holder_ = fingerprint;
    close_tries_ = 0;
  }

  bool stopping() {
    const std::lock_guard lock(mutex_);
    return stopping_;
  }

  /// False when there is nothing to wait for: the server stops or the client has left.
  bool wait_until(Clock::time_point due, const Context& context) {
    std::unique_lock lock(mutex_);
    while (!stopping_ && !context.IsCancelled()) {
      const auto now = Clock::now();
      if (now >= due) return true;
      wake_.wait_until(lock, std::min(due, now + kLeaveCheck));
    }
    return false;
  }

  ControlService service_;
  std::string side_;
  bool secured_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  int watchers_ = 0;
  std::uint64_t session_ = 0;
  int close_tries_ = 0;
  std::string holder_;  // fingerprint of the master that opened it
};

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
  State(ControlBackend& backend, std::string_view side, bool secured) : control(backend, side, secured) {}
  GrpcControl control;
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
