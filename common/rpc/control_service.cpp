#include "common/rpc/control_service.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/config/config.hpp"
#include "common/config/effective.hpp"
#include "common/recording/build_name.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

Refusal invalid(std::string message) { return {Refusal::Kind::kInvalid, std::move(message)}; }

/// Why a message cannot be meant, or none.
std::optional<Refusal> wrong(const google::protobuf::Message& message) {
  try {
    validate(message);
  } catch (const ConfigError& error) {
    return invalid(error.what());
  }
  return {};
}

ControlService::Result<proto::Outcome> outcome(std::optional<Refusal> refusal, std::string done) {
  if (refusal) return *std::move(refusal);
  proto::Outcome outcome;
  outcome.set_message(std::move(done));
  return outcome;
}

ControlService::Result<proto::Outcome> said(std::variant<std::string, Refusal> answer) {
  if (auto* refusal = std::get_if<Refusal>(&answer)) return std::move(*refusal);
  return outcome({}, std::get<std::string>(std::move(answer)));
}

/// A window of time, s from now; it has begun when start is 0.
struct Window {
  double start_s = 0.0;
  double duration_s = 0.0;
};

Window later(Window window, double elapsed_s) {
  const double left_s = window.start_s - elapsed_s;
  if (left_s >= 0.0) return {left_s, window.duration_s};
  return {0.0, std::max(window.duration_s + left_s, 0.0)};
}

/// The next window of a periodic row that has not begun yet.
Window next(Window window, double period_s, double elapsed_s) {
  const double left_s = window.start_s - elapsed_s;
  if (left_s >= 0.0) return {left_s, window.duration_s};
  return {left_s + period_s * std::ceil(-left_s / period_s), window.duration_s};
}

std::string count_in_words(int count) {
  return count == 1 ? "1 field was set" : std::to_string(count) + " fields were set";
}

}  // namespace

/// Returns a sentence for each kind of assigned field that has no effect beside the other values.
std::string without_effect(const google::protobuf::Message& config, const Assignments& assignments) {
  Origins assigned;
  for (const auto& [path, value] : assignments) assigned.replace(config, path, std::string(kFromCommandLine));
  std::string text;
  const auto add = [&](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) text += "; " + sentence;
  };
  if (const auto* slave = dynamic_cast<const proto::SlaveConfig*>(&config))
    add(ineffective_settings(*slave, assigned));
  if (const auto* master = dynamic_cast<const proto::MasterConfig*>(&config))
    add(ineffective_settings(*master, assigned));
  return text;
}

proto::Impairment continued(proto::Impairment link, double elapsed_s) {
  constexpr double kDelayMaxS = 100.0;  // the schema's range of delay_s
  if (!(elapsed_s > 0.0)) return link;
  if (link.drift_s_per_s() != 0.0)
    link.set_delay_s(std::clamp(link.delay_s() + link.drift_s_per_s() * elapsed_s, 0.0, kDelayMaxS));
  if (link.step_duration_s() > 0.0) {
    const Window step = later({link.step_start_s(), link.step_duration_s()}, elapsed_s);
    link.set_step_start_s(step.start_s);
    link.set_step_duration_s(step.duration_s);
  }
  if (link.blackout_duration_s() > 0.0) {
    const Window window{link.blackout_start_s(), link.blackout_duration_s()};
    const double period_s = link.blackout_period_s();
    const Window blackout = period_s > 0.0 ? next(window, period_s, elapsed_s) : later(window, elapsed_s);
    link.set_blackout_start_s(blackout.start_s);
    link.set_blackout_duration_s(blackout.duration_s);
  }
  return link;
}

ControlService::ControlService(ControlBackend& backend) : backend_(backend), link_set_at_(Clock::now()) {}

proto::Status ControlService::status() {
  proto::Status status = backend_.status();
  *status.mutable_impairment() = link_from_now();
  return status;
}

ControlService::Result<proto::GetConfigResponse> ControlService::get_config(
    const proto::GetConfigRequest& request) {
  const std::lock_guard lock(printing_);
  try {
    proto::GetConfigResponse response;
    const auto present = backend_.config(), start = backend_.start_config();
    response.set_text(request.origin()
                          ? get_field_with_origins(*present, request.path(), start.get(),
                                                   with_clients(backend_.start_origins(), *start, *present))
                          : get_field(*present, request.path(), start.get()));
    return response;
  } catch (const ConfigError& error) {
    return invalid(error.what());
  }
}

ControlService::Result<proto::Outcome> ControlService::set_config(const proto::SetConfigRequest& request) {
  if (request.assignment().empty()) return invalid("no field was given: give at least one path and value");
  Assignments assignments;
  bool sets_link = false;
  for (const proto::Assignment& assignment : request.assignment()) {
    if (assignment.path().empty())
      return invalid("a value has no path: name the field, e.g. estimator.forgetting");
    sets_link |= assignment.path().starts_with("link.");
    assignments.emplace_back(assignment.path(), assignment.value());
  }
  const std::lock_guard lock(changing_);
  std::optional<Refusal> refusal = backend_.set_config(assignments);
  if (!refusal && sets_link) link_set_at_ = Clock::now();
  return outcome(std::move(refusal),
                 count_in_words(request.assignment_size()) + without_effect(*backend_.config(), assignments));
}

proto::Impairment ControlService::get_link() { return link_from_now(); }

proto::Impairment ControlService::link_from_now() {
  const std::chrono::duration<double> elapsed = Clock::now() - link_set_at_.load();
  return continued(backend_.link(), elapsed.count());
}

ControlService::Result<proto::Outcome> ControlService::set_link(const proto::SetLinkRequest& request) {
  if (std::optional<Refusal> refusal = wrong(request.impairment())) return *refusal;
  const std::lock_guard lock(changing_);
  proto::Impairment wanted;
  if (!request.replace()) wanted = link_from_now();
  wanted.MergeFrom(request.impairment());
  if (std::optional<Refusal> refusal = wrong(wanted)) return *refusal;
  std::optional<Refusal> refusal = backend_.set_link(wanted);
  if (!refusal) link_set_at_ = Clock::now();
  return outcome(std::move(refusal),
                 request.replace() ? "the link impairment was replaced" : "the link impairment was changed");
}

ControlService::Result<proto::Outcome> ControlService::run(const proto::Action& action) {
  switch (action.action_case()) {
    case proto::Action::ACTION_NOT_SET:  // also that of a newer client, or its unknown mode
      return invalid("the action is missing or unknown to version " + std::string(build_version()) +
                     " of this side: run the same version of all programs");
    case proto::Action::kSet:
      return set_config(action.set());
    case proto::Action::kLink:
      return set_link(action.link());
    default:
      break;
  }
  proto::Mapping mapping;  // knows the range
  if (action.has_scale()) mapping.set_scale(action.scale());
  if (action.has_kv_per_s()) mapping.set_kv_per_s(action.kv_per_s());
  if (std::optional<Refusal> refusal = wrong(mapping)) return *refusal;
  const double max_mb = action.start_recording().max_mb();
  if (!(max_mb >= 1.0 && max_mb <= 1e6)) return invalid("max_mb must be from 1 to 1000000");
  const std::lock_guard lock(changing_);
  return said(backend_.run(action));
}

ControlService::Result<proto::Outcome> ControlService::stop() { return outcome(backend_.stop(), "stopped"); }

ControlService::Result<proto::OpenSessionResponse> ControlService::open_session(
    const proto::OpenSessionRequest& request, const std::string& caller) {
  const std::lock_guard lock(changing_);
  return backend_.open_session(request, caller);
}

ControlService::Result<proto::Outcome> ControlService::close_session(
    const proto::CloseSessionRequest& request) {
  const std::lock_guard lock(changing_);
  return outcome(backend_.close_session(request.session()), "control of the robot was returned");
}

}  // namespace longreach
