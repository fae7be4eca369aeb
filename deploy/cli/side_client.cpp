#include "deploy/cli/side_client.hpp"

#include <google/protobuf/text_format.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "common/recording/build_name.hpp"
#include "common/rpc/rpc_channel.hpp"
#include "common/rpc/rpc_delay.hpp"
#include "common/rpc/rpc_server.hpp"
#include "common/site/site.hpp"
#include "common/text/number_text.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr auto kRetryAfter = std::chrono::milliseconds(500);

const std::string& address_of(Side side, const Options& options) {
  return side == Side::kMaster ? options.master_address : options.slave_address;
}

/// "the slave does not respond at 127.0.0.1:47020 within 3 s"
std::string does_not_respond(Side side, const Options& options, std::optional<double> within_s = {}) {
  std::string sentence =
      "the " + std::string(name_of(side)) + " does not respond at " + address_of(side, options);
  return within_s ? sentence + " within " + format_number(std::round(100.0 * *within_s) / 100.0) + " s"
                  : sentence;
}

/// "waiting for the first answer of the slave: 5 of 10 s", with the delay if it is known
std::string awaits(Side side, double since_s, double delay_s) {
  const std::string of = delay_s > 0.0 ? " of " + format_number(std::round(delay_s)) : "";
  return "waiting for the first answer of the " + std::string(name_of(side)) + ": " +
         format_number(std::round(since_s)) + of + " s";
}

SideError down(Side side, const Options& options, const grpc::Status& status,
               const RpcConnection::Progress& progress) {
  const bool late = status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
  const double waited_s = progress.waited_s + progress.response_s;
  const std::string name(name_of(side));
  const std::string start = "start longreach-" + name + ", or give its address with --" + name + " HOST:PORT";
  const ConnectFailure why = connect_failure(status);
  const bool absent =
      why == ConnectFailure::kRefused || why == ConnectFailure::kUnreachable || progress.host_silent;
  const bool broken = why == ConnectFailure::kClosed || why == ConnectFailure::kLost;
  return {
      absent   ? SideError::Kind::kAbsent
      : broken ? SideError::Kind::kBroken
               : SideError::Kind::kDown,
      does_not_respond(side, options, late ? options.timeout_s.value_or(waited_s) : std::optional<double>()) +
          ": " + connect_trouble(status, progress, start)};
}

bool refused_by_side(const grpc::ClientContext& context) {
  return context.GetServerTrailingMetadata().contains(grpc::string_ref(kRefusedBy.data(), kRefusedBy.size()));
}

SideError wrong_side(Side side, const Options& options, const std::string& found) {
  const std::string name(name_of(side));
  return {SideError::Kind::kRefused, "the program at " + address_of(side, options) + " is the " + found +
                                         ", not the " + name + ": correct --" + name};
}

/// `version` of the side; empty: unknown. A side that names the call itself is refused_by_side().
SideError lacks_call(Side side, const Options& options, const std::string& version) {
  const std::string is_of = version.empty() ? "" : " is of version " + version + " and";
  return {SideError::Kind::kRefused,
          "the " + std::string(name_of(side)) + " at " + address_of(side, options) + is_of +
              " does not have this call of version " + std::string(build_version()) +
              ": run the same version of all programs"};
}

/// Estimates how long a response was on its way: connecting takes three round trips.
double one_way_s(const RpcConnection& connection, const proto::Status& status) {
  const double artificial_s =
      status.side() == name_of(Side::kSlave) ? status.impairment().rpc_delay_s() : 0.0;
  return connection.connect_s() / 6.0 + artificial_s / 2.0;
}

/// Throws if the side that responds is not the expected one.
void check_side(Side side, const Options& options, const proto::Status& status) {
  if (!status.has_side() || status.side() == name_of(side)) return;
  throw wrong_side(side, options, status.side());
}

}  // namespace

std::shared_ptr<RpcConnection> RpcConnections::to(Side side, const Options& options) {
  const std::lock_guard lock(mutex_);
  auto& open = open_[side == Side::kMaster ? 0 : 1];
  if (!open) {
    RpcSecurity security;
    if (!options.insecure)
      security.credentials = site_credentials(
          options.site.empty() ? default_site() : std::filesystem::path(options.site), RpcRole::kClient);
    const RpcRole role = side == Side::kMaster ? RpcRole::kMaster : RpcRole::kSlave;
    open = std::make_shared<RpcConnection>(address_of(side, options), role, security);
  }
  return open;
}

void RpcConnections::cancel() {
  const std::lock_guard lock(mutex_);
  for (const auto& one : open_)
    if (one) one->cancel();
}

std::shared_ptr<RpcConnection> connection_to(Side side, const Options& options) {
  return options.connections ? options.connections->to(side, options) : RpcConnections().to(side, options);
}

SideError failure(Side side, const Options& options, const grpc::ClientContext& context,
                  const grpc::Status& status, const RpcConnection::Progress& progress) {
  const std::string the_side = "the " + std::string(name_of(side));
  const std::string refusal = the_side + " refuses: " + status.error_message();
  if (status.error_code() == grpc::StatusCode::INVALID_ARGUMENT) return {SideError::Kind::kBadValue, refusal};
  if (refused_by_side(context)) return {SideError::Kind::kRefused, refusal};
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      if (other_role(status)) return wrong_side(side, options, side == Side::kMaster ? "slave" : "master");
      return down(side, options, status, progress);
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::CANCELLED:
      return down(side, options, status, progress);
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return {SideError::Kind::kRefused,
              the_side + " sent a response that is too large: " + status.error_message()};
    case grpc::StatusCode::UNIMPLEMENTED:
      return lacks_call(side, options, "");
    default:
      return {SideError::Kind::kRefused, refusal};
  }
}

struct SideClient::State {
  State(Side the_side, const Options& the_options)
      : side(the_side), options(the_options), connection(connection_to(side, options)) {}

  const Side side;
  const Options options;
  const std::shared_ptr<RpcConnection> connection;
  const std::unique_ptr<proto::Control::Stub> stub = proto::Control::NewStub(connection->channel());
  std::atomic<bool> cancelled{false};
  std::mutex mutex;
  grpc::ClientContext* open = nullptr;  // call in progress

  template <class Answer, class Request>
  Answer call(grpc::Status (proto::Control::Stub::*method)(grpc::ClientContext*, const Request&, Answer*),
              const Request& request) {
    Answer answer;
    std::optional<double> delay_s;  // artificial, which the side reports if the deadline is too early
    const auto attempt = [&](const RpcConnection::Progress& progress) -> std::optional<SideError> {
      grpc::ClientContext context;
      context.set_deadline(progress.call_until);
      const RpcConnection::Call in_progress(*connection, context);
      begin(&context);
      const grpc::Status status = (stub.get()->*method)(&context, request, &answer);
      begin(nullptr);
      delay_s = artificial_delay_s(context.GetServerTrailingMetadata());
      if (status.ok()) return other_side(context);
      if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) return lacks_call(side, options, version());
      return failure(side, options, context, status, progress);
    };
    auto progress = connection->connect(options.timeout_s, cancelled);
    auto error = attempt(progress);
    if (error && delay_s && !options.timeout_s) {
      progress.allow(*delay_s);
      error = attempt(progress);
    }
    // A handshake that broke may only have been lost; the request was not sent.
    if (error && error->kind() == SideError::Kind::kBroken && !cancelled)
      error = attempt(connection->connect(options.timeout_s, cancelled, &progress));
    if (error) throw *error;
    return answer;
  }

  /// Of the side, also if it is older; empty: it does not say.
  std::string version() {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(3));
    proto::Status answer;
    (void)stub->GetStatus(&context, {}, &answer);
    return answer.version();
  }

  /// An error if the program that responded is not the expected side.
  std::optional<SideError> other_side(const grpc::ClientContext& context) const {
    const auto& metadata = context.GetServerTrailingMetadata();
    const auto found = metadata.find(grpc::string_ref(kAnsweredBy.data(), kAnsweredBy.size()));
    if (found == metadata.end()) return {};
    const std::string name(found->second.data(), found->second.size());
    return name == name_of(side) ? std::nullopt : std::optional(wrong_side(side, options, name));
  }

  void begin(grpc::ClientContext* context) {
    const std::lock_guard lock(mutex);
    open = context;
    if (open != nullptr && cancelled) open->TryCancel();
  }
};

SideClient::SideClient(Side side, const Options& options) : state_(std::make_unique<State>(side, options)) {}
SideClient::SideClient(SideClient&&) noexcept = default;
SideClient::~SideClient() = default;

void SideClient::cancel() {
  const std::lock_guard lock(state_->mutex);
  state_->cancelled = true;
  if (state_->open != nullptr) state_->open->TryCancel();
}

SideReport SideClient::report() {
  SideReport report{.side = state_->side, .address = state_->connection->address()};
  try {
    report.status = status();
    report.age_s = one_way_s(*state_->connection, *report.status);
  } catch (const SideError& error) {
    report.error = error.what();
  }
  return report;
}

proto::Status SideClient::status() {
  auto status = state_->call(&proto::Control::Stub::GetStatus, proto::StatusRequest());
  check_side(state_->side, state_->options, status);
  return status;
}

std::string SideClient::get(const std::string& path, bool origin) {
  proto::GetConfigRequest request;
  request.set_path(path);
  if (origin) request.set_origin(true);
  return state_->call(&proto::Control::Stub::GetConfig, request).text();
}

void SideClient::take_part(const std::string& path, google::protobuf::Message& message) {
  if (!google::protobuf::TextFormat::ParseFromString(get(path), &message))
    throw SideError(SideError::Kind::kRefused, "the " + std::string(name_of(state_->side)) + "'s " + path +
                                                   " is invalid: run the same version of all programs");
}

std::string SideClient::run(const proto::Action& action) {
  return state_->call(&proto::Control::Stub::Do, action).message();
}

std::string SideClient::set(const std::vector<std::pair<std::string, std::string>>& assignments) {
  proto::Action action;
  for (const auto& [path, value] : assignments) {
    proto::Assignment& assignment = *action.mutable_set()->add_assignment();
    assignment.set_path(path);
    assignment.set_value(value);
  }
  return run(action);
}

proto::Impairment SideClient::link() {
  return state_->call(&proto::Control::Stub::GetLink, proto::GetLinkRequest());
}

std::string SideClient::set_link(const proto::Impairment& impairment, bool replace) {
  proto::Action action;
  *action.mutable_link()->mutable_impairment() = impairment;
  action.mutable_link()->set_replace(replace);
  return run(action);
}

std::string SideClient::stop() {
  return state_->call(&proto::Control::Stub::Stop, proto::StopRequest()).message();
}

struct StatusStream::State {
  State(Side the_side, const Options& the_options, double the_rate_hz)
      : side(the_side),
        options(the_options),
        rate_hz(the_rate_hz),
        connection(connection_to(side, options)) {}

  /// Reads a stream until it ends.
  void read() {
    const auto progress = connection->connect(options.timeout_s, ended);
    grpc::ClientContext context;
    if (!progress.connected) context.set_deadline(progress.call_until);
    {
      const std::lock_guard lock(mutex);
      if (ended) return;
      silence_max = Seconds(options.timeout_s.value_or(progress.response_s) + 2.0 / rate_hz);
      open = &context;
    }
    proto::WatchRequest request;
    request.set_rate_hz(rate_hz);
    const auto stream = stub->Watch(&context, request);
    stream->WaitForInitialMetadata();
    if (const auto delay_s = artificial_delay_s(context.GetServerInitialMetadata());
        delay_s && !options.timeout_s) {
      const std::lock_guard lock(mutex);
      silence_max += Seconds(*delay_s);
      first_delay_s = *delay_s;
    }
    std::string wrong_side;
    for (proto::Status status; wrong_side.empty() && stream->Read(&status);) {
      try {
        check_side(side, options, status);
        take(std::move(status));
      } catch (const SideError& wrong) {
        wrong_side = wrong.what();
        context.TryCancel();
      }
    }
    const grpc::Status end = stream->Finish();
    const std::lock_guard lock(mutex);
    open = nullptr;
    newest.reset();
    error =
        wrong_side.empty() ? std::string(failure(side, options, context, end, progress).what()) : wrong_side;
  }

  void take(proto::Status status) {
    const std::lock_guard lock(mutex);
    newest = std::move(status);
    received = Clock::now();
    error.clear();
  }

  void run() {
    std::unique_lock lock(mutex);
    while (!ended) {
      lock.unlock();
      read();
      lock.lock();
      changed.wait_for(lock, kRetryAfter, [this] { return ended.load(); });
    }
  }

  const Side side;
  const Options options;
  const double rate_hz;
  const std::shared_ptr<RpcConnection> connection;
  const std::unique_ptr<proto::Control::Stub> stub = proto::Control::NewStub(connection->channel());
  std::mutex mutex;
  std::condition_variable changed;
  std::atomic<bool> ended = false;
  double first_delay_s = 0.0;  // artificial delay of the first status; 0: none, or not known yet
  Seconds silence_max{};       // a stream without a message for longer counts as down
  grpc::ClientContext* open = nullptr;
  std::optional<proto::Status> newest;
  std::string error;
  Clock::time_point received = Clock::now();  // or the start
  std::thread reader;
};

StatusStream::StatusStream(Side side, const Options& options, double rate_hz)
    : state_(std::make_unique<State>(side, options, rate_hz)) {
  state_->reader = std::thread([state = state_.get()] { state->run(); });
}

StatusStream::~StatusStream() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ended = true;
    if (state_->open != nullptr) state_->open->TryCancel();
    state_->changed.notify_all();
  }
  state_->reader.join();
}

SideReport StatusStream::newest() const {
  const std::lock_guard lock(state_->mutex);
  SideReport report{.side = state_->side,
                    .address = address_of(state_->side, state_->options),
                    .status = state_->newest,
                    .error = state_->error};
  const double silence_s = Seconds(Clock::now() - state_->received).count();
  if (report.status && silence_s > state_->silence_max.count()) report.status.reset();
  if (!report.status && report.error.empty()) {
    report.awaited = !state_->newest && (silence_s < state_->silence_max.count() || !state_->open);
    report.error = report.awaited ? awaits(state_->side, silence_s, state_->first_delay_s)
                                  : does_not_respond(state_->side, state_->options, silence_s);
  }
  if (report.status) report.age_s = silence_s + one_way_s(*state_->connection, *report.status);
  return report;
}

bool StatusStream::settled() const {
  const std::lock_guard lock(state_->mutex);
  return state_->newest || !state_->error.empty();
}

}  // namespace longreach
