#include "common/rpc/session_client.hpp"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "common/rpc/rpc_channel.hpp"
#include "common/rpc/rpc_connection.hpp"
#include "common/rpc/rpc_delay.hpp"
#include "common/rpc/rpc_server.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {
namespace {

using std::chrono::milliseconds;

constexpr double kSilence_s = 1.0;  // after which the slave is asked; it gives a session away no sooner
constexpr auto kLookPeriod = milliseconds(50);
constexpr auto kAfterAnswer = milliseconds(1000);  // the datagrams are given time to come
constexpr auto kReturnTimeout = std::chrono::seconds(2);
constexpr auto kRetryFirst = milliseconds(100);
constexpr auto kRetryLast = milliseconds(2000);

/// The master that has the robot, as the slave says.
std::string holder_of(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerTrailingMetadata();
  const auto found = metadata.find(grpc::string_ref(kHeldBy.data(), kHeldBy.size()));
  return found == metadata.end() ? "" : std::string(found->second.data(), found->second.size());
}

std::string sentence(const std::string& address, const grpc::ClientContext& context,
                     const grpc::Status& status, const RpcConnection::Progress& progress) {
  const std::string begin = "no session with the slave at " + address + ": ";
  if (context.GetServerTrailingMetadata().contains(grpc::string_ref(kRefusedBy.data(), kRefusedBy.size())))
    return begin + status.error_message();
  if (status.error_code() == grpc::StatusCode::PERMISSION_DENIED) return begin + status.error_message();
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED)
    return begin + "it does not support this call; run the same version of all programs";
  if (other_role(status)) return begin + "the program there is not a slave; set link.slave_rpc";
  return begin + connect_trouble(
                     status, progress,
                     "start longreach-slave there, or set link.slave_rpc to the address of its RPC server");
}

}  // namespace

struct SessionClient::Rpc {
  RpcConnection connection;
  std::unique_ptr<proto::Control::Stub> stub = proto::Control::NewStub(connection.channel());
};

SessionClient::SessionClient(std::string address, const RpcSecurity& security, bool take, double send_hz,
                             Presence presence, Adopt adopt)
    : address_(std::move(address)),
      presence_(std::move(presence)),
      adopt_(std::move(adopt)),
      rpc_(new Rpc{{address_, RpcRole::kSlave, security}}),
      take_(take),
      send_hz_(send_hz),
      thread_([this] { run(); }) {}

SessionClient::~SessionClient() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (call_ != nullptr) call_->TryCancel();
    wake_.notify_all();
  }
  thread_.join();
  give_back();
}

void SessionClient::give_back() {
  proto::CloseSessionRequest request;
  request.set_session(presence_().session);
  if (request.session() == 0) return;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kReturnTimeout);
  proto::Outcome outcome;
  // A slave that does not hear of it gives the robot to another master when this one has been silent for 1 s.
  (void)rpc_->stub->CloseSession(&context, request, &outcome);
}

std::string SessionClient::taken_by() const {
  const std::lock_guard lock(mutex_);
  return taken_by_;
}

std::string SessionClient::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void SessionClient::run() {
  milliseconds retry = kRetryFirst;
  milliseconds pause{};
  do {
    const Present present = presence_();
    const bool needed = present.session == 0 || present.silence_s > kSilence_s;
    pause = kLookPeriod;
    if (!needed) {
      const std::lock_guard lock(mutex_);
      trouble_.clear();
      taken_by_.clear();
      continue;
    }
    std::string trouble = connect(present.session);
    const bool done = trouble.empty();
    if (done) trouble = unreceived(present);
    pause = done ? kAfterAnswer : retry;
    retry = done ? kRetryFirst : std::min(2 * retry, kRetryLast);
    const std::lock_guard lock(mutex_);
    trouble_ = std::move(trouble);
  } while (wait(pause));
}

/// Asks once, and again if the slave delays calls artificially. Empty: the loop has a session that the slave knows; else why not.
std::string SessionClient::connect(std::uint64_t present, double more_time_s) {
  auto progress = rpc_->connection.connect(std::nullopt, ended_);
  progress.allow(more_time_s);
  grpc::ClientContext context;
  context.set_deadline(progress.call_until);
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return trouble_;
    call_ = &context;
  }
  proto::OpenSessionRequest request;
  request.set_session(present);
  request.set_aes256gcm(has_aes256gcm());
  request.set_take(take_);
  request.set_send_hz(send_hz_);
  proto::OpenSessionResponse answer;
  const auto asked_at = std::chrono::steady_clock::now();
  const grpc::Status status = rpc_->stub->OpenSession(&context, request, &answer);
  call_took_ = std::chrono::steady_clock::now() - asked_at;
  {
    const std::lock_guard lock(mutex_);
    call_ = nullptr;
  }
  const std::string holder = holder_of(context);
  {
    const std::lock_guard lock(mutex_);
    if (status.ok()) taken_by_.clear();
    if (!holder.empty() && present != 0) taken_by_ = holder;
  }
  if (!holder.empty() && present != 0)
    return "another master (" + holder +
           ") took control of the robot; stop that master, or restart this one with --take";
  const auto delay_s = artificial_delay_s(context.GetServerTrailingMetadata());
  if (!status.ok() && delay_s && more_time_s == 0.0) return connect(present, *delay_s);
  if (!status.ok()) return sentence(address_, context, status, progress);
  if (!answer.has_secret() && present != 0 && answer.session() == present) return "";

  Session session{.number = answer.session(),
                  .cipher = answer.aes256gcm() ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305};
  const bool usable = session.number != 0 && answer.secret().size() == session.secret.size() &&
                      (session.cipher != Cipher::kAes256Gcm || has_aes256gcm());
  if (!usable)
    return "no session with the slave at " + address_ +
           ": its response is invalid; run the same version of all programs";
  std::memcpy(session.secret.data(), answer.secret().data(), session.secret.size());
  wipe(*answer.mutable_secret());
  take_ = false;  // whoever takes it from here later is not robbed in turn
  adopted_at_ = std::chrono::steady_clock::now();
  return adopt_(session)
             ? ""
             : "no session with the slave at " + address_ + ": the control loop did not accept the session";
}

/// The slave knows the session, and nothing comes of it: datagrams do not get through where RPC does.
std::string SessionClient::unreceived(const Present& present) const {
  constexpr auto kBesides = std::chrono::seconds(2);
  const std::chrono::duration<double> round_trip =
      call_took_ + std::chrono::duration<double>(present.delay_s);
  const bool due = std::chrono::steady_clock::now() - adopted_at_ > round_trip + kBesides;
  if (present.session == 0 || std::isfinite(present.silence_s) || !due) return "";
  const std::string begin =
      "RPC at " + address_ + " responds, but no datagrams arrive from " + present.slave + ": ";
  if (present.unknown_peers > 0)
    return begin + std::to_string(present.unknown_peers) +
           " datagrams arrived from other addresses; set link.slave to the address from which the slave sends, "
           "or remove the address translation on the path";
  return begin +
         "allow UDP through the firewalls in both directions, and check that link.slave and "
         "link.slave_rpc refer to the same slave";
}

/// False: it is time to end.
bool SessionClient::wait(milliseconds time) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, time, [this] { return ended_.load(); });
  return !ended_;
}

std::string slave_rpc_address(const std::string& slave, const std::string& slave_rpc) {
  if (!slave_rpc.empty()) return slave_rpc;
  return slave.substr(0, slave.rfind(':')) +
         std::string(kSlaveRpcAddress.substr(kSlaveRpcAddress.rfind(':')));
}

}  // namespace longreach
