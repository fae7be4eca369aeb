#include "common/rpc/rpc_connection.hpp"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "common/net/tcp_probe.hpp"
#include "common/rpc/rpc_channel.hpp"

namespace longreach {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

constexpr auto kProgressCheck = milliseconds(10);
constexpr double kProbeAfter_s = 0.5;   // a fast connection needs no probe
constexpr double kHostAnswer_s = 15.0;  // 10 s of delay; the kernel repeats a lost SYN after 1, 3 and 7 s
constexpr double kConnected_s = 60.0;   // three round trips of 10 s, with as much for lost segments
constexpr double kRepeated_s = 1.0;     // gRPC repeats an attempt after 0.2 s
constexpr double kResponse_s = 3.0;     // of a slave that is busy, beyond the delay

RpcConnection::Clock::time_point after(RpcConnection::Clock::time_point begin, double seconds) {
  return begin + std::chrono::duration_cast<RpcConnection::Clock::duration>(duration<double>(seconds));
}

std::string seconds_text(double seconds) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.2f s", seconds);
  return text.data();
}

}  // namespace

RpcConnection::RpcConnection(std::string address, RpcRole side, const RpcSecurity& security)
    : address_(std::move(address)), channel_(connect_rpc(address_, side, security)) {}

RpcConnection::RpcConnection(std::string address)
    : address_(std::move(address)), channel_(connect_in_clear(address_)) {}

RpcConnection::Progress RpcConnection::connect(std::optional<double> timeout_s,
                                               const std::atomic<bool>& cancelled, const Progress* failed) {
  const auto begin = Clock::now();
  if (timeout_s && failed != nullptr) *timeout_s -= failed->waited_s;
  const auto until = after(begin, timeout_s.value_or(kConnected_s));
  Progress out;
  std::optional<TcpProbe> probe;
  auto state = channel_->GetState(true);
  const bool was_connected = state == GRPC_CHANNEL_READY;
  // A failure that is known already may be over.
  const bool known = failed != nullptr || state == GRPC_CHANNEL_TRANSIENT_FAILURE;
  const double failure_after_s =
      (known ? kRepeated_s : 0.0) + (failed != nullptr ? 2.0 * failed->waited_s : 0.0);
  while (state != GRPC_CHANNEL_READY && !cancelled && !cancelled_) {
    out.waited_s = duration<double>(Clock::now() - begin).count();
    out.failed = state == GRPC_CHANNEL_TRANSIENT_FAILURE && out.waited_s >= failure_after_s;
    if (out.failed || Clock::now() >= until) break;
    if (!probe && out.waited_s > kProbeAfter_s) probe.emplace(address_);
    const bool unanswered = probe && probe->run_for(milliseconds(1)) == TcpProbe::State::kPending;
    if (probe) out.tcp_s = probe->handshake_s();
    out.host_silent = unanswered;
    if (unanswered && !timeout_s && out.waited_s > kProbeAfter_s + kHostAnswer_s) break;
    (void)channel_->WaitForStateChange(state, std::min(until, Clock::now() + kProgressCheck));
    state = channel_->GetState(true);
  }
  out.connected = state == GRPC_CHANNEL_READY;
  out.waited_s = duration<double>(Clock::now() - begin).count();
  if (out.connected && !was_connected) connect_s_ = out.waited_s;
  // A call on a failed connection returns the reason at once. On an unfinished one there is no time left.
  if (out.connected || out.failed) out.response_s = kResponse_s + 2.0 * connect_s_;
  if (timeout_s) out.response_s = std::max(0.0, *timeout_s - out.waited_s);
  out.call_until = after(Clock::now(), out.response_s);
  return out;
}

void RpcConnection::Progress::allow(double more_s) {
  response_s += more_s;
  call_until = after(Clock::now(), response_s);
}

RpcConnection::Call::Call(RpcConnection& connection, grpc::ClientContext& context)
    : connection_(connection), context_(context) {
  const std::lock_guard lock(connection_.mutex_);
  connection_.calls_.push_back(&context_);
  if (connection_.cancelled_) context_.TryCancel();
}

RpcConnection::Call::~Call() {
  const std::lock_guard lock(connection_.mutex_);
  std::erase(connection_.calls_, &context_);
}

void RpcConnection::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  for (grpc::ClientContext* call : calls_) call->TryCancel();
}

std::string connect_trouble(const grpc::Status& status, const RpcConnection::Progress& progress,
                            const std::string& start) {
  switch (connect_failure(status)) {
    case ConnectFailure::kRefused:
      return "no program is listening there; " + start;
    case ConnectFailure::kUnreachable:
      return "its host is not reachable; check the address and the network";
    case ConnectFailure::kUnknownHost:
      return "the name of its host cannot be resolved; check the name, or use a numeric address";
    case ConnectFailure::kNotTls:
      return "the program there does not use TLS; check the port, and give --insecure to both or to neither";
    case ConnectFailure::kMistrusted:
      return "its certificate is not valid for this site; use the same site folder for both (--site)";
    case ConnectFailure::kOwnCertificate:
      return "the certificate or the key of this program cannot be used; run longreach doctor";
    case ConnectFailure::kLost:
      return "the connection was reset during the handshake; check the network, and try again";
    case ConnectFailure::kClosed:
      return "it closed the connection during the TLS handshake, so it probably does not trust this program's "
             "certificate; use the same site folder for both (--site), and give --insecure to both or to neither";
    case ConnectFailure::kOther:
      break;
  }
  if (status.error_code() != grpc::StatusCode::DEADLINE_EXCEEDED) return "the connection ended; " + start;
  const std::string more_time = progress.waited_s < kConnected_s
                                    ? "if the link is slow, allow more time with --timeout; otherwise "
                                    : "";
  if (progress.connected)
    return "the connection was complete after " + seconds_text(progress.waited_s) +
           ", but no response arrived in " + seconds_text(progress.response_s) + "; " + more_time +
           "check that the program there is not suspended";
  if (!progress.tcp_s)
    return (progress.host_silent ? "its host has not answered a TCP handshake; check the firewalls, " : "") +
           start;
  return "its host answered a TCP handshake within " + seconds_text(*progress.tcp_s) +
         ", but the TLS handshake was not complete after " + seconds_text(progress.waited_s) + "; " +
         more_time + "find out which program has this port";
}

}  // namespace longreach
