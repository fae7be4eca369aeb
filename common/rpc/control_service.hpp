#pragma once
// The calls of proto/control.proto without their transport: validates a request, merges it, and passes
// complete, valid requests to the backend of the side. Changes are processed one at a time, so that a change
// of the link is read, merged and written atomically; stop and status do not wait for them. A refused call
// changes nothing. Callable from any thread.
//
// Field paths of the configuration are handled by the backend, the rate of Watch by RpcServer.

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <variant>

#include "common/rpc/control_backend.hpp"

namespace longreach {

/// Returns the impairment that is equivalent to `link` after `elapsed_s`: the drift is included in the delay,
/// and the windows of step and blackout are shifted or have ended. Changing one field therefore does not
/// repeat a blackout. A periodic blackout in progress ends; the next one comes when it is due.
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
  /// The impairment from now on: see continued().
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
  std::atomic<Instant> link_set_at_;  // when the windows of the present impairment started
};

}  // namespace longreach
