#pragma once
// proto/control.proto over gRPC: ControlService with the rate of Watch, the session holder, refusals as status codes, and
// the artificial delay of calls (rpc_delay.hpp). RpcServer owns it.

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <variant>

#include "common/loop/pace.hpp"
#include "common/program/log.hpp"
#include "common/rpc/caller_certificate.hpp"
#include "common/rpc/control_service.hpp"
#include "common/rpc/rpc_delay.hpp"
#include "common/rpc/rpc_refusals.hpp"
#include "common/rpc/rpc_server.hpp"
#include "common/rpc/status_fields.hpp"
#include "common/site/revocations.hpp"
#include "common/text/number_text.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach {

/// ControlService over gRPC: one blocking call a thread, of which there may be none left; but stop, which
/// waits for nobody, and the status, which is asked most, are answered by the thread that hears the question.
class ControlRpc final : public proto::Control::WithCallbackMethod_Stop<
                             proto::Control::WithCallbackMethod_GetStatus<proto::Control::Service>> {
 public:
  using Context = grpc::ServerContext;
  using CallbackContext = grpc::CallbackServerContext;

  ControlRpc(ControlBackend& backend, std::string_view side, bool secured)
      : service_(backend), side_(side), secured_(secured) {}

  grpc::ServerUnaryReactor* GetStatus(CallbackContext* context, const proto::StatusRequest*,
                                      proto::Status* answer) override {
    return respond(context, [=, this] {
      *answer = status();
      return grpc::Status::OK;
    });
  }
  grpc::ServerUnaryReactor* Stop(CallbackContext* context, const proto::StopRequest*,
                                 proto::Outcome* answer) override {
    return respond(context, [=, this] { return finish(context, service_.stop(), answer); });
  }
  grpc::Status GetConfig(Context* context, const proto::GetConfigRequest* request,
                         proto::GetConfigResponse* answer) override {
    return delayed(context, [&] { return finish(context, service_.get_config(*request), answer); });
  }
  // The link is shown and set without delay, so that every delay can be shown and changed.
  grpc::Status GetLink(Context* context, const proto::GetLinkRequest*, proto::Impairment* answer) override {
    context->AddTrailingMetadata(std::string(kAnsweredBy), side_);
    *answer = service_.get_link();
    return grpc::Status::OK;
  }
  grpc::Status Do(Context* context, const proto::Action* action, proto::Outcome* answer) override {
    const auto run = [&] { return finish(context, service_.run(*action), answer); };
    return action->has_link() ? run() : delayed(context, run);
  }
  grpc::Status OpenSession(Context* context, const proto::OpenSessionRequest* request,
                           proto::OpenSessionResponse* answer) override {
    if (!is_master(*context)) return denied(*context, "only a master of this site may open a session");
    return delayed(context, [&] {
      const grpc::Status status =
          finish(context, service_.open_session(*request, caller_of(*context)), answer);
      if (status.ok()) note_holder(answer->session(), fingerprint_of(*context->auth_context()));
      return status;
    });
  }
  grpc::Status CloseSession(Context* context, const proto::CloseSessionRequest* request,
                            proto::Outcome* answer) override {
    if (!is_master(*context)) return denied(*context, "only a master of this site may close a session");
    // A master that ends does not wait for the response.
    (void)wait(delay_of(*context).request);
    return finish(context, service_.close_session(*request), answer);
  }

  grpc::Status Watch(Context* context, const proto::WatchRequest* request,
                     grpc::ServerWriter<proto::Status>* writer) override {
    const Slot slot(*this);
    if (!slot.taken())
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, std::to_string(kWatchersMax) +
                                                        " clients are already watching the " + side_ +
                                                        ": close one of them"};
    const RpcDelay::Times delay = delay_of(*context);
    delay_.accept(context->peer());
    context->AddInitialMetadata(std::string(kRpcDelay), format_number(delay.total_s()));
    writer->SendInitialMetadata();
    if (!wait(delay.request)) return shutting_down();
    send_statuses(*context, watch_rate_hz(*request), *writer);
    return stopping() ? shutting_down() : grpc::Status::OK;
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
  using Clock = std::chrono::steady_clock;

  static constexpr int kCloseTries = 50;
  // How soon a client that left, or the end of the server, is noticed.
  static constexpr std::chrono::milliseconds kLeaveCheck{100};

  static grpc::StatusCode code_of(Refusal::Kind kind) {
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
  static std::string cut(std::string text) {
    constexpr std::size_t kMessageMaxBytes = 2000;
    if (text.size() <= kMessageMaxBytes) return text;
    std::size_t end = kMessageMaxBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
  }

  static double watch_rate_hz(const proto::WatchRequest& request) {
    if (!request.has_rate_hz()) return kWatchHzDefault;
    if (!(request.rate_hz() > kWatchHzMin)) return kWatchHzMin;  // also what is not a number
    return std::min(request.rate_hz(), kWatchHzMax);
  }

  /// A watcher's place among kWatchersMax.
  class Slot {
   public:
    explicit Slot(ControlRpc& control) : control_(control) {
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
    ControlRpc& control_;
    bool taken_ = false;
  };

  /// Executes a call and responds, each after its delay, and occupies no thread until then. The call is executed
  /// even if the client cancels it, because the cancellation would arrive later than the request.
  class DelayedCall final : public grpc::ServerUnaryReactor {
   public:
    DelayedCall(ControlRpc& control, const RpcDelay::Times& delay, std::function<grpc::Status()> call)
        : control_(control), delay_(delay), call_(std::move(call)), due_(Clock::now() + delay.request) {
      wait();
    }
    void OnDone() override { delete this; }

   private:
    void wait() {
      const Clock::duration left = std::clamp<Clock::duration>(due_ - Clock::now(), {}, kLeaveCheck);
      alarm_ = std::make_unique<grpc::Alarm>();
      alarm_->Set(std::chrono::system_clock::now() + left, [this](bool) { proceed(); });
    }
    void proceed() {
      if (control_.stopping()) return Finish(control_.shutting_down());
      if (Clock::now() < due_) return wait();
      if (!call_) return Finish(status_);
      status_ = std::exchange(call_, nullptr)();
      due_ = Clock::now() + delay_.response;
      wait();
    }

    ControlRpc& control_;
    const RpcDelay::Times delay_;
    std::function<grpc::Status()> call_;  // none: it was executed
    Clock::time_point due_;
    grpc::Status status_;
    std::unique_ptr<grpc::Alarm> alarm_;
  };

  template <class Call>
  grpc::ServerUnaryReactor* respond(CallbackContext* context, const Call& call) {
    const RpcDelay::Times delay = delay_of(*context);
    const bool accepted = accept(*context, delay);
    if (accepted && delay.total_s() > 0.0) return new DelayedCall(*this, delay, call);
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(accepted ? call() : too_late(*context, delay));
    return reactor;
  }

  /// As respond(), in the thread of the call.
  template <class Call>
  grpc::Status delayed(Context* context, const Call& call) {
    const RpcDelay::Times delay = delay_of(*context);
    if (!accept(*context, delay)) return too_late(*context, delay);
    if (!wait(delay.request)) return shutting_down();
    const grpc::Status status = call();
    return wait(delay.response) ? status : shutting_down();
  }

  RpcDelay::Times delay_of(const grpc::ServerContextBase& context) {
    return side_ == "slave" ? delay_.of(context.peer(), service_.get_link().rpc_delay_s())
                            : RpcDelay::Times{};
  }
  /// False: the deadline of the call is too early for the delay.
  bool accept(const grpc::ServerContextBase& context, const RpcDelay::Times& delay) {
    const std::chrono::duration<double> left = context.deadline() - std::chrono::system_clock::now();
    const bool in_time = left.count() > delay.total_s() || delay.total_s() == 0.0;
    if (in_time) delay_.accept(context.peer());
    return in_time;
  }
  grpc::Status too_late(grpc::ServerContextBase& context, const RpcDelay::Times& delay) {
    context.AddTrailingMetadata(std::string(kRefusedBy), side_);
    context.AddTrailingMetadata(std::string(kRpcDelay), format_number(delay.total_s()));
    return {grpc::StatusCode::FAILED_PRECONDITION,
            "the artificial delay of this call is " + format_number(delay.total_s()) +
                " s: allow more time with --timeout, or remove the delay with `longreach link set --rpc 0`"};
  }
  grpc::Status shutting_down() const {
    return {grpc::StatusCode::UNAVAILABLE, "the " + side_ + " is shutting down"};
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

  /// Sends the status at a rate, each one after the delay of the responses.
  void send_statuses(const Context& context, double rate_hz, grpc::ServerWriter<proto::Status>& writer) {
    std::deque<std::pair<Clock::time_point, proto::Status>> delayed;  // when to send it, and the status
    for (Pace pace(rate_hz);;) {
      const auto due = delayed.empty() ? pace.due() : std::min(pace.due(), delayed.front().first);
      if (!wait_until(due, context) || is_revoked(*context.auth_context())) return;
      if (Clock::now() >= pace.due()) {
        const auto send_at = Clock::now() + delay_of(context).response;
        delayed.emplace_back(delayed.empty() ? send_at : std::max(send_at, delayed.back().first), status());
        pace.advance();
      }
      for (; !delayed.empty() && delayed.front().first <= Clock::now(); delayed.pop_front())
        if (!writer.Write(delayed.front().second)) return;
    }
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

  /// False: the server stops.
  bool wait(Clock::duration time) {
    if (time == Clock::duration::zero()) return true;
    std::unique_lock lock(mutex_);
    return !wake_.wait_for(lock, time, [this] { return stopping_; });
  }

  ControlService service_;
  std::string side_;
  bool secured_;
  RpcDelay delay_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  int watchers_ = 0;
  std::uint64_t session_ = 0;
  int close_tries_ = 0;
  std::string holder_;  // fingerprint of the master that opened it
};

}  // namespace longreach
