#pragma once
// The calls of proto/control.proto without their transport: checks what was asked, merges, and passes whole,
// valid requests to the side's backend. Changes go one at a time, so that one of the link reads, merges and
// writes in one go; stop and status wait for none of them. A refused call has changed nothing. Callable from
// any thread.
//
// Does not handle: field paths of the configuration (the backend's), pacing of Watch (RpcServer's).

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <variant>

#include "common/rpc/control_backend.hpp"

namespace longreach {

/// The impairment that acts like `link` as seen `elapsed_s` after it was set: the drift has gone into the
/// delay, the windows of step and blackout have come nearer or are over. So that changing one field does not
/// repeat a blackout. A periodic blackout that is under way ends; the next one comes when it was due.
proto::Impairment continued(proto::Impairment link, double elapsed_s);

class ControlService {
 public:
  template <class Answer>
  using Result = std::variant<Answer, Refusal>;

  /// `backend` must outlive the service.
  explicit ControlService(ControlBackend& backend);

  proto::Status status();
  Result<proto::GetConfigResponse> get_config(const proto::GetConfigRequest& request);
  Result<proto::Outcome> set_config(const proto::SetConfigRequest& request);
  /// As it acts from now on: see continued().
  proto::Impairment get_link();
  Result<proto::Outcome> set_link(const proto::SetLinkRequest& request);
  Result<proto::Outcome> set_mode(const proto::SetModeRequest& request);
  Result<proto::Outcome> set_scale(const proto::SetScaleRequest& request);
  Result<proto::Outcome> engage();
  Result<proto::Outcome> stop();
  Result<proto::OpenSessionResponse> open_session(const proto::OpenSessionRequest& request,
                                                  const std::string& caller);
  Result<proto::Outcome> close_session(const proto::CloseSessionRequest& request);
  Result<proto::Outcome> start_recording(const proto::StartRecordingRequest& request);
  Result<proto::Outcome> stop_recording();

 private:
  using Instant = std::chrono::steady_clock::time_point;

  proto::Impairment link_from_now();

  ControlBackend& backend_;
  std::mutex changing_;
  std::mutex printing_;               // one configuration at a time
  std::atomic<Instant> link_set_at_;  // when the windows of the present impairment began to count
};

}  // namespace longreach
