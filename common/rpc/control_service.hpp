#pragma once
// Implements the calls of proto/control.proto independently of their transport. Validates each request,
// merges it with the current state and passes it to the backend of the side. Changes are processed one at a
// time, so that a link change is read, merged and written atomically; stop and status do not wait for
// changes. A refused call changes nothing. Thread-safe.
//
// The backend handles field paths of the configuration, and RpcServer handles the rate of Watch.

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <variant>

#include "common/rpc/control_backend.hpp"

namespace longreach {

/// Returns an impairment that continues `link` after `elapsed_s`: the drift so far is added to the delay, and
/// the times of the delay step and the blackout are counted from now. A blackout that has passed is therefore
/// not repeated when another field is changed. A periodic blackout that is in progress ends; the next one
/// starts on time.
proto::Impairment continued(proto::Impairment link, double elapsed_s);

class ControlService {
 public:
  template <class Answer>
  using Result = std::variant<Answer, Refusal>;

  /// `backend` must outlive the service.
  explicit ControlService(ControlBackend& backend);

  proto::Status status();
  Result<proto::GetConfigResponse> get_config(const proto::GetConfigRequest& request);
  /// Returns the impairment relative to the current time; see continued().
  proto::Impairment get_link();
  /// Carries out a action.
  Result<proto::Outcome> run(const proto::Action& action);
  Result<proto::Outcome> stop();
  Result<proto::OpenSessionResponse> open_session(const proto::OpenSessionRequest& request,
                                                  const std::string& caller);
  Result<proto::Outcome> close_session(const proto::CloseSessionRequest& request);

 private:
  using Instant = std::chrono::steady_clock::time_point;

  Result<proto::Outcome> set_config(const proto::SetConfigRequest& request);
  Result<proto::Outcome> set_link(const proto::SetLinkRequest& request);
  proto::Impairment link_from_now();

  ControlBackend& backend_;
  std::mutex changing_;
  std::mutex printing_;               // serializes the printing of configurations
  std::atomic<Instant> link_set_at_;  // time to which the windows of the current impairment refer
};

}  // namespace longreach
